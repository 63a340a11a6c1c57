// Collects sources of the mesh pass and spreads them to a grid.
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

// One grid and the sources that wait for it; T is the type of the windows.
template <typename T>
class GridSources {
 public:
  GridSources(const NonuniformPlan& plan, const GridKernel<T>& kernel)
      : spreader_(plan, kernel), degree_(plan.fourier.degree) {}

  void add(std::span<const Node> nodes);
  void add(const GradientNode& node);
  // Adds vertices in the form of load_vertices(). They are counted only if they have Hessians.
  void add_vertices(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                    const BlockParameters& parameters, const VertexLump<LumpOf<T>>* lumps);
  void flush();

  // Sum of squares of all counted weights. Gradients count by gradient_as_weight(); nodes on a
  // meridian count three times.
  double source2() const { return source2_; }
  // Sum of squares of L^2 times Hessians.
  double hessian2() const { return hessian2_; }
  GridSpreader<T> take_spreader() { return std::move(spreader_); }
  // The cells, once all sources are flushed.
  double* cells() { return spreader_.grid(); }
  // Counts the sources that another grid has spread as this grid's. The caller adds its cells.
  void count_as_own(const GridSources& other) {
    source2_ += other.source2_;
    hessian2_ += other.hessian2_;
  }
  // Writes the content of the grid, once all is flushed. Zero cells are left out.
  void write(ByteWriter& writer);
  // Adds the content that another grid of the same kind has written.
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

// Collects a part's nodes for its grid.
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
