// Sources of the mesh pass on their way to a grid.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/bytes.h"
#include "harmonic/nonuniform/nonuniform.h"
#include "harmonic/nonuniform/window_error.h"
#include "rholm/coefficients.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/mesh_part.h"
#include "transform/mesh_pass/node_sink.h"
#include "transform/mesh_pass/plan/plan.h"
#include "transform/mesh_pass/vertex_lumps.h"

namespace rholm {

// One grid and the sources that wait for it; windows in T.
template <typename T>
class GridSources {
 public:
  GridSources(const NonuniformPlan& plan, const GridKernel<T>& kernel)
      : spreader_(plan, kernel), degree_(plan.fourier.degree) {}

  void add(std::span<const Node> nodes);
  void add(const GradientNode& node);
  // Vertices as load_vertices() takes them; counted only if they have Hessians.
  void add_vertices(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                    const BlockParameters& parameters, const VertexLump<LumpOf<T>>* lumps);
  void flush();

  // Sum of squares of all weights that were counted, gradients by gradient_as_weight(), nodes on a
  // meridian three times.
  double source2() const { return source2_; }
  // And of L^2 times Hessians.
  double hessian2() const { return hessian2_; }
  GridSpreader<T> take_spreader() { return std::move(spreader_); }
  // The cells, once all is flushed.
  double* cells() { return spreader_.grid(); }
  // What another grid has spread counts as this one's; its cells are added by whoever calls.
  void count_as_own(const GridSources& other) {
    source2_ += other.source2_;
    hessian2_ += other.hessian2_;
  }
  // What is in the grid, once all is flushed: of its cells those that are not zero.
  void write(ByteWriter& writer);
  // Adds what another grid of the same kind has written.
  void add_written(ByteReader& reader);

 private:
  static constexpr std::size_t kSize = SourceBatch<T>::kSize;
  void flush_values();
  void flush_gradients();

  GridSpreader<T> spreader_;
  double source2_ = 0, hessian2_ = 0;
  int degree_;
  SourceBatch<T> values_, gradients_;
  std::size_t n_values_ = 0, n_gradients_ = 0;
};

// A part's nodes on their way to its grid.
template <typename T>
class PartSink : public NodeSink {
 public:
  PartSink(MeshPart<T>& part, GridSources<T>& grid, const MeshPlan& plan)
      : part_(part), grid_(grid), plan_(plan) {}
  void add(std::span<const Node> nodes) override;
  void add_gradient(const GradientNode& node) override;
  void add_undivided(const Vec3& x, double weight) override;
  void sum_undivided();

 private:
  MeshPart<T>& part_;
  GridSources<T>& grid_;
  const MeshPlan& plan_;
  std::vector<Vec3> undivided_;
  std::vector<double> undivided_weights_;
};

}  // namespace rholm
