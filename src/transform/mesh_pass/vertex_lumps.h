// Lumps of vertices, and their way to the grid: the inner loops of the mesh pass's second half.
#pragma once

#include <cstddef>
#include <cstdint>

#include "harmonic/nonuniform/spread.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/block/block.h"

namespace rholm {

// Vertices worked on together: as many as a batch takes.
inline constexpr std::size_t kVerticesPerBlock = SourceBatch<double>::kSize;
// Room for the lumps of a block.
inline constexpr std::size_t kLumpsPerBlock = lumps_per_vertex(true) * kVerticesPerBlock;

// sums += n lumps: exact, in integers modulo 2^32.
template <typename L>
void add_lumps(const VertexLump<L>* lumps, std::size_t n, VertexLump<L>* sums);

// Lumps of n <= kVerticesPerBlock vertices, as sum_lumps() and load_vertices() take them, which may
// be in `room`: with Hessians, what is first of all vertices comes first, then kVerticesPerBlock
// lumps further on what is second, and third; zeros up to whole vectors behind the last.
template <typename L>
const VertexLump<L>* arranged(const VertexLump<L>* lumps, std::size_t n, bool hessians,
                              VertexLump<L>* room);

// Of lumps, in quanta.
struct LumpSums {
  double weight = 0;     // their sum
  double weight2 = 0;    // sum of squares of weights
  double gradient2 = 0;  // and of gradients
  double hessian2 = 0;   // and of Hessians

  void add(const LumpSums& other);
};
// Of weights and gradients of a block, as arranged() has them.
LumpSums sum_lumps(const VertexLump<std::int32_t>* lumps, std::size_t n);
LumpSums sum_lumps(const VertexLump<double>* lumps, std::size_t n);

// Sources of n <= kVerticesPerBlock vertices with these numbers, in ascending order, whose lumps
// are given, eight at a time: read up to a multiple of that. Vertices without a lump may lie
// anywhere. With Hessians, returns sums of squares of the sources: derivatives at unit distance and
// as far as they are tangential, for a harmonic does not change along the radius, which on steep
// surfaces most of an edge may be.
LumpSums load_vertices(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                       const BlockParameters& parameters, const VertexLump<std::int32_t>* lumps,
                       SourceBatch<float>& batch);
LumpSums load_vertices(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                       const BlockParameters& parameters, const VertexLump<double>* lumps,
                       SourceBatch<double>& batch);

}  // namespace rholm
