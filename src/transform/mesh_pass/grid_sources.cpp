#include "transform/mesh_pass/grid_sources.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "rholm/harmonic.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kCellsInRow = 64;  // chosen: a part of a mesh in order leaves most rows empty
constexpr std::size_t kMostUndivided = std::size_t{1} << 18;

template <typename T>
void put(SourceBatch<T>& batch, std::size_t n, const Vec3& x, double weight) {
  batch.x[0][n] = x.x;
  batch.x[1][n] = x.y;
  batch.x[2][n] = x.z;
  batch.value[n] = static_cast<T>(weight);
}

// Returns a sum over weights, by four sums that do not wait for each other.
template <typename Term>
double sum_of(std::span<const Node> nodes, const Term& term) {
  double sums[4] = {};
  std::size_t i = 0;
  for (; i + 4 <= nodes.size(); i += 4) {
    for (std::size_t k = 0; k < 4; ++k) sums[k] += term(nodes[i + k].weight);
  }
  for (; i < nodes.size(); ++i) sums[0] += term(nodes[i].weight);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

// Returns the node's term in the sum of squares. The edges of a face that is seen edge on are at
// right angles to their gradient. If the gradient is level, these edges lie on a meridian and are
// alike for the columns of the grid. Then windows err up to three times as much as on even
// directions (walls seen edge on in pass_test).
double counted2(const GradientNode& node, int degree) {
  const double square = dot(node.weight, node.weight);
  const bool level = std::pow(4 * degree * node.weight.z, 2) <= square;
  return std::pow((level ? 3 : 1) * gradient_as_weight(degree), 2) * square;
}

}  // namespace

template <typename T>
void GridSources<T>::add(std::span<const Node> nodes) {
  source2_ += sum_of(nodes, [](double weight) { return weight * weight; });
  while (!nodes.empty()) {
    const std::size_t n = std::min(nodes.size(), kSize - n_values_);
    for (std::size_t i = 0; i < n; ++i) put(values_, n_values_ + i, nodes[i].x, nodes[i].weight);
    n_values_ += n;
    if (n_values_ == kSize) flush_values();
    nodes = nodes.subspan(n);
  }
}

template <typename T>
void GridSources<T>::add(const GradientNode& node) {
  put(gradients_, n_gradients_, node.x, 0);
  const double g[3] = {node.weight.x, node.weight.y, node.weight.z};
  for (int k = 0; k < 3; ++k) gradients_.gradient[k][n_gradients_] = static_cast<T>(g[k]);
  source2_ += counted2(node, degree_);
  if (++n_gradients_ == kSize) flush_gradients();
}

template <typename T>
void GridSources<T>::add_vertices(const MeshView& mesh, const std::uint32_t* numbers, std::size_t n,
                                  const BlockParameters& parameters,
                                  const VertexLump<LumpOf<T>>* lumps) {
  flush_gradients();
  const LumpSums sums = load_vertices(mesh, numbers, n, parameters, lumps, gradients_);
  if (parameters.hessians) {
    source2_ += sums.weight2 + std::pow(gradient_as_weight(degree_), 2) * sums.gradient2;
    hessian2_ += std::pow(parameters.degree, 4) * sums.hessian2;
  }
  spreader_.add(gradients_, n, parameters.hessians ? 2 : 1);
}

template <typename T>
void GridSources<T>::write(ByteWriter& writer) {
  writer.value(source2_);
  writer.value(hessian2_);
  write_sparse(writer, std::span<const double>(cells(), spreader_.n_cells()), kCellsInRow,
               [](double cell) { return cell == 0; });
}

template <typename T>
void GridSources<T>::add_written(ByteReader& reader) {
  double source2 = 0, hessian2 = 0;
  reader.value(source2);
  reader.value(hessian2);
  source2_ += source2;
  hessian2_ += hessian2;
  double* const all = cells();
  read_sparse<double>(reader, spreader_.n_cells(), kCellsInRow,
                      [&](std::size_t first, std::span<const double> row) {
                        for (std::size_t i = 0; i < row.size(); ++i) all[first + i] += row[i];
                      });
}

template <typename T>
void GridSources<T>::flush() {
  flush_values();
  flush_gradients();
}

template <typename T>
void GridSources<T>::flush_values() {
  if (n_values_ > 0) spreader_.add(values_, n_values_, 0);
  n_values_ = 0;
}

template <typename T>
void GridSources<T>::flush_gradients() {
  if (n_gradients_ > 0) spreader_.add(gradients_, n_gradients_, 1);
  n_gradients_ = 0;
}

template <typename T>
void PartSink<T>::add(std::span<const Node> nodes) {
  part_.nodes += nodes.size();
  part_.weight += sum_of(nodes, [](double weight) { return weight; });
  part_.modulus += sum_of(nodes, [](double weight) { return std::abs(weight); });
  grid_.add(nodes);
}

template <typename T>
void PartSink<T>::add_gradient(const GradientNode& node) {
  ++part_.nodes;
  grid_.add(node);
}

template <typename T>
void PartSink<T>::add_undivided(const Vec3& x, double weight) {
  ++part_.nodes;
  undivided_.push_back(x / norm(x));
  undivided_weights_.push_back(weight);
  if (undivided_.size() >= kMostUndivided) sum_undivided();
}

template <typename T>
void PartSink<T>::sum_undivided() {
  if (undivided_.empty()) return;
  const int degree = plan_.divided.degree;
  if (part_.undivided.degree() != degree) part_.undivided = Coefficients(degree);
  // The precision is relative to sums with random signs, (L + 1) sqrt(sum w^2 / 4 pi). Walls may be
  // aligned with the grid, as all walls of a gear are. Then errors may all add up.
  double modulus = 0;
  for (const double w : undivided_weights_) modulus += std::abs(w);
  const double relative = plan_.allowed.window / ((degree + 1.0) * modulus / std::sqrt(4 * kPi));
  add_adjoint({.directions = undivided_, .weights = undivided_weights_}, part_.undivided,
              {.precision = std::clamp(0.5 * relative, 1e-14, 0.1)}, {.threads = 1});
  undivided_.clear();
  undivided_weights_.clear();
}

template class GridSources<float>;
template class GridSources<double>;
template class PartSink<float>;
template class PartSink<double>;

}  // namespace rholm
