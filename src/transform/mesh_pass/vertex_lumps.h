// Sums lumps of vertices and loads them for the grid: inner loops of the pass's second half.
#pragma once

#include <cstddef>
#include <cstdint>

#include "harmonic/nonuniform/spread.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/block/block.h"

namespace rholm {

// Number of vertices that are processed together: the size of a batch.
inline constexpr std::size_t kVerticesPerBlock = SourceBatch<double>::kSize;
// Largest number of lumps of a block.
inline constexpr std::size_t kLumpsPerBlock = lumps_per_vertex(true) * kVerticesPerBlock;

// Adds n lumps to `sums`: exact, in integers modulo 2^32.
template <typename L>
void add_lumps(const VertexLump<L>* lumps, std::size_t n, VertexLump<L>* sums);

// Returns lumps of n <= kVerticesPerBlock vertices for sum_lumps() and load_vertices(), in `room`
// if need be. With Hessians, first lumps of all vertices come first; second and third lumps follow
// at steps of kVerticesPerBlock lumps. Zeros fill whole vectors at the end.
template <typename L>
const VertexLump<L>* arranged(const VertexLump<L>* lumps, std::size_t n, bool hessians,
                              VertexLump<L>* room);

// Sums over lumps, in quanta.
struct LumpSums {
  double weight = 0;     // sum of weights
  double weight2 = 0;    // sum of squares of weights
  double gradient2 = 0;  // sum of squares of gradients
  double hessian2 = 0;   // sum of squares of Hessians

  void add(const LumpSums& other);
};
// Return the sums of weights and gradients of a block in the order of arranged().
LumpSums sum_lumps(const VertexLump<std::int32_t>* lumps, std::size_t n);
LumpSums sum_lumps(const VertexLump<double>* lumps, std::size_t n);

// Loads the sources of n <= kVerticesPerBlock vertices with these numbers, in ascending order.
// Their lumps are read eight at a time, up to a multiple of eight. Vertices without a lump may lie
// anywhere. With Hessians, returns sums of squares of the sources: the tangential parts of
// derivatives, at unit distance. A harmonic does not change along the radius, and on steep surfaces
// most of an edge may be radial.
LumpSums load_vertices(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                       const BlockParameters& parameters, const VertexLump<std::int32_t>* lumps,
                       SourceBatch<float>& batch);
LumpSums load_vertices(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                       const BlockParameters& parameters, const VertexLump<double>* lumps,
                       SourceBatch<double>& batch);

}  // namespace rholm
