// What a block of worked triangles hands on: lumps to their vertices, and a sample of half-edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "transform/mesh_pass/block/block.h"

namespace rholm {

// Adds the lumps of the block's first n triangles that are lumped; lumps_per_vertex(hessians) of a
// vertex follow each other, those of `first_vertex` at `vertices`.
template <typename T>
void scatter_lumps(const MeshView& mesh, std::size_t first, std::size_t n, bool hessians,
                   const TriangleBlock<T>& block, VertexLump<T>* vertices,
                   std::uint32_t first_vertex = 0);

// Asks for the lumps of triangles that are worked next: they lie as far apart as the vertices do.
template <typename T>
void ask_for_lumps(const MeshView& mesh, std::size_t first, std::size_t n, bool hessians,
                   const VertexLump<T>* vertices, std::uint32_t first_vertex = 0);

// Adds to each vertex the names of those that follow it in a triangle, and takes those away that it
// follows: zero where the triangles around it are closed, and else by chance once in 2^32.
template <typename T>
void link_fans(const MeshView& mesh, std::size_t first, std::size_t n,
               const TriangleBlock<T>& block, std::uint32_t* fans, std::uint32_t first_vertex);

// Appends the sampled half-edges of the block's first n triangles.
template <typename T>
void sample_half_edges(const TriangleBlock<T>& block, std::size_t n,
                       std::vector<SampledHalfEdge>& sample);

}  // namespace rholm
