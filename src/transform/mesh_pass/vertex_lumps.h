// Lumps of vertices, and their way to the grid: the inner loops of the mesh pass's second half.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "base/aligned_array.h"
#include "harmonic/nonuniform/spread.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/block/block.h"

namespace rholm {

// Vertices worked on together: as many as a batch takes.
inline constexpr std::size_t kVerticesPerBlock = SourceBatch<double>::kSize;
// Room for the lumps of a block.
inline constexpr std::size_t kLumpsPerBlock = lumps_per_vertex(true) * kVerticesPerBlock;

// Arrays of lumps, one a thread. Sums of lumps are exact in any order: a thread takes any array
// that is free.
template <typename L>
class LumpArrays {
 public:
  using Array = AlignedArray<VertexLump<L>>;
  LumpArrays(std::size_t n_vertices, bool hessians)
      : n_vertices_(n_vertices), per_vertex_(lumps_per_vertex(hessians)) {}
  std::unique_ptr<Array> take();
  void give_back(std::unique_ptr<Array> array);
  // The sums of all arrays for n <= kVerticesPerBlock vertices from `first` on, which may be in
  // `room`; zeros beyond the last vertex of the mesh. With Hessians, what is first of all vertices
  // comes first, then kVerticesPerBlock lumps further on what is second, and third.
  const VertexLump<L>* sums(std::size_t first, std::size_t n, VertexLump<L>* room) const;

 private:
  std::size_t n_vertices_, per_vertex_;
  std::vector<std::unique_ptr<Array>> free_;
  std::mutex mutex_;
};

// Of lumps, in quanta.
struct LumpSums {
  double weight = 0;     // their sum
  double weight2 = 0;    // sum of squares of weights
  double gradient2 = 0;  // and of gradients
  double hessian2 = 0;   // and of Hessians

  void add(const LumpSums& other);
};
// Of a block, as LumpArrays::sums() has them.
LumpSums sum_lumps(const VertexLump<std::int32_t>* lumps, std::size_t n, bool hessians);
LumpSums sum_lumps(const VertexLump<double>* lumps, std::size_t n, bool hessians);

// Sources of n <= kVerticesPerBlock vertices from `first` on, whose lumps are given, eight at a
// time: read up to a multiple of that. Vertices without a lump may lie anywhere. With Hessians,
// returns sums of squares of the sources: derivatives at unit distance and as far as they are
// tangential, for a harmonic does not change along the radius, which on steep surfaces most of an
// edge may be.
LumpSums load_vertices(const MeshView& mesh, std::size_t first, std::size_t n,
                       const BlockParameters& parameters, const VertexLump<std::int32_t>* lumps,
                       SourceBatch<float>& batch);
LumpSums load_vertices(const MeshView& mesh, std::size_t first, std::size_t n,
                       const BlockParameters& parameters, const VertexLump<double>* lumps,
                       SourceBatch<double>& batch);

}  // namespace rholm
