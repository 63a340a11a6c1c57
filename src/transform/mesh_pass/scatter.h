// Passes on the results of a block of faces: lumps to vertices, and a sample of half-edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "transform/mesh_pass/block/block.h"

namespace rholm {

// Places of the corners of a block's faces among the lumps. Corner k of face t has the number at
// record + t stride + 4 k, counted from `first`.
struct CornerPlaces {
  const std::byte* record = nullptr;
  std::size_t stride = 0;
  std::uint32_t first = 0;
};

// Adds the lumps of the lumped faces among the block's first n faces. The
// lumps_per_vertex(hessians) lumps of a vertex follow each other.
template <typename T>
void scatter_lumps(const CornerPlaces& places, std::size_t n, bool hessians,
                   const TriangleBlock<T>& block, VertexLump<T>* vertices);

// Prefetches the lumps of the next faces, which are as far apart as their vertices.
template <typename T>
void ask_for_lumps(const CornerPlaces& places, std::size_t n, bool hessians,
                   const VertexLump<T>* vertices);

// Adds to each vertex the names of the vertices after it in a face, less the names before it. The
// sum is zero where the faces around it are closed, and by chance once in 2^32.
template <typename T>
void link_fans(const CornerPlaces& places, std::size_t n, const TriangleBlock<T>& block,
               std::uint32_t* fans);

// Appends the sampled half-edges of the block's first n faces.
template <typename T>
void sample_half_edges(const TriangleBlock<T>& block, std::size_t n,
                       std::vector<SampledHalfEdge>& sample);

}  // namespace rholm
