// What a block of worked triangles hands on: lumps to their vertices, and a sample of half-edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "transform/mesh_pass/block/block.h"

namespace rholm {

// Where the corners of a block's triangles are among the lumps: corner k of triangle t has the
// number at record + t stride + 4 k, counted from `first` on.
struct CornerPlaces {
  const std::byte* record = nullptr;
  std::size_t stride = 0;
  std::uint32_t first = 0;
};

// Adds the lumps of the block's first n triangles that are lumped; lumps_per_vertex(hessians) of a
// vertex follow each other.
template <typename T>
void scatter_lumps(const CornerPlaces& places, std::size_t n, bool hessians,
                   const TriangleBlock<T>& block, VertexLump<T>* vertices);

// Asks for the lumps of triangles that are worked next: they lie as far apart as the vertices do.
template <typename T>
void ask_for_lumps(const CornerPlaces& places, std::size_t n, bool hessians,
                   const VertexLump<T>* vertices);

// Adds to each vertex the names of those that follow it in a triangle, and takes those away that it
// follows: zero where the triangles around it are closed, and else by chance once in 2^32.
template <typename T>
void link_fans(const CornerPlaces& places, std::size_t n, const TriangleBlock<T>& block,
               std::uint32_t* fans);

// Appends the sampled half-edges of the block's first n triangles.
template <typename T>
void sample_half_edges(const TriangleBlock<T>& block, std::size_t n,
                       std::vector<SampledHalfEdge>& sample);

}  // namespace rholm
