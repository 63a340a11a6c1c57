// Sources of the mesh pass on their way to a grid.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "harmonic/nonuniform/nonuniform.h"
#include "harmonic/nonuniform/window_error.h"
#include "rholm/coefficients.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/node_sink.h"
#include "transform/mesh_pass/plan/plan.h"
#include "transform/mesh_pass/vertex_lumps.h"

namespace rholm {

// Single precision goes with sums in whole quanta of 32 bits.
template <typename T>
using LumpOf = std::conditional_t<sizeof(T) == 4, std::int32_t, double>;

// One grid and the sources that wait for it; windows in T.
template <typename T>
class GridSources {
 public:
  GridSources(const NonuniformPlan& plan, const GridKernel<T>& kernel)
      : spreader_(plan, kernel), degree_(plan.fourier.degree) {}

  void add(std::span<const Node> nodes);
  void add(const GradientNode& node);
  // Vertices as load_vertices() takes them; counted only if they have Hessians.
  void add_vertices(const MeshView& mesh, std::size_t first, std::size_t n,
                    const BlockParameters& parameters, const VertexLump<LumpOf<T>>* lumps);
  void flush();

  // Sum of squares of all weights that were counted, gradients by gradient_as_weight(), nodes on a
  // meridian three times.
  double source2() const { return source2_; }
  // And of L^2 times Hessians.
  double hessian2() const { return hessian2_; }
  GridSpreader<T> take_spreader() { return std::move(spreader_); }

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

// What one part of the triangles leaves.
struct MeshPart {
  BlockSums sums = no_triangles();
  double mean = 0;  // int r dOmega over triangles with nodes for it
  std::vector<SampledHalfEdge> half_edges;
  // Nodes that wait for a grid, unless they are too many.
  std::vector<Node> kept;
  std::vector<GradientNode> kept_gradients;
  bool too_many = false;
  double source2 = 0;      // of those kept
  double weight = 0;       // sum of weights, of all that are divided by l(l+1)
  double modulus = 0;      // and of their moduli
  std::size_t nodes = 0;   // of all
  double node_error2 = 0;  // see NodeWriter::error2()
  Coefficients undivided;  // of nodes that are not divided by l(l+1), if there are any
};

// Where a part's nodes go: to a grid or, if there is none yet, kept.
template <typename T>
class PartSink : public NodeSink {
 public:
  PartSink(MeshPart& part, GridSources<T>* grid, const MeshPlan& plan)
      : part_(part), grid_(grid), plan_(plan) {}
  void add(std::span<const Node> nodes) override;
  void add_gradient(const GradientNode& node) override;
  void add_undivided(const Vec3& x, double weight) override;
  void sum_undivided();

 private:
  MeshPart& part_;
  GridSources<T>* grid_;
  const MeshPlan& plan_;
  std::vector<Vec3> undivided_;
  std::vector<double> undivided_weights_;
};

}  // namespace rholm
