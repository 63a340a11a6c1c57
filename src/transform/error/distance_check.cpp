#include "transform/error/distance_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "transform/error/closest_distances.h"

namespace rholm {
namespace {

constexpr std::size_t kCoarse = 100, kMostFaces = 2'000'000;
constexpr double kFarApart = 1e3;

// The ratio of root mean squares of five hundred points is known to a fraction of a per cent: both
// are of the same points.
constexpr int kSteps = 2;
// Points that err most by first order, so many at a time, until no other can be expected to err
// more.
constexpr std::size_t kBatch = 64;
constexpr double kCloseRms = 0.02, kCloseMax = 0.04, kFarRms = 0.1;
constexpr std::size_t kFine = 1000;

// Of each point the larger of both ways.
std::vector<double> first_order(const PointErrors& errors) {
  std::vector<double> values(errors.to_model.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = std::max(errors.to_model[i], errors.to_shape[i]);
  }
  return values;
}

}  // namespace

bool is_coarse(const MeshView& mesh) { return mesh.n_triangles <= kCoarse; }

bool may_be_refined(const MeshView& mesh, const Expansion& expansion, double largest_radial_error,
                    double diagonal) {
  const double mean = std::abs(expansion.coefficients.c(0, 0)) / std::sqrt(4 * std::numbers::pi);
  const double radius = expansion.function == RadialFunction::kGauge ? 1 / mean : mean;
  return mesh.n_triangles <= kMostFaces && largest_radial_error < kFarApart * diagonal &&
         kFarApart * radius > diagonal;
}

bool SecondOrder::first_order_holds() const {
  return std::abs(rms_ratio - 1) <= kCloseRms && std::abs(max_ratio - 1) <= kCloseMax;
}

bool SecondOrder::suffices(const MeshView& mesh) const {
  return mesh.n_triangles > kFine && std::abs(rms_ratio - 1) <= kFarRms;
}

SecondOrder second_order(const ErrorPoints& points, const PointErrors& errors, std::size_t first,
                         const RadialModel& model) {
  const std::vector<double> values = first_order(errors);
  const std::vector<std::size_t> worst = indices_of_largest(values, kMostWorstPoints);
  SecondOrder result;
  if (worst.empty()) return result;
  const double scale = std::exp2(-std::ilogb(std::max(largest(points.radii), 1e-300)));
  const Context context{.threads = 1};  // waking others takes longer than a thousand points
  const RadialSurface surface(model, scale, context);
  const auto distances = [&](const std::vector<std::size_t>& indices) {
    std::vector<Vec3> x, from;
    for (const std::size_t i : indices) {
      x.push_back(scale * points.radii[i] * points.directions[i]);
      from.push_back(points.directions[i]);
    }
    return surface.distances(x, std::move(from), kSteps);
  };
  std::vector<std::size_t> sample;
  const std::size_t step = std::max<std::size_t>(1, (points.size() - first) / kDistanceSample);
  for (std::size_t i = first; i < points.size(); i += step) sample.push_back(i);
  // There, and back: to planes of faces, which are no nearer than the faces; what a point of the
  // mesh is from the model, the model near it is from the mesh.
  double there = 0, there_first = 0, back = 0, back_first = 0, weights = 0;
  const std::vector<double> found = distances(sample);
  for (std::size_t k = 0; k < sample.size(); ++k) {
    const std::size_t i = sample[k];
    const double to_shape = scale * errors.to_shape[i];
    there += found[k] * found[k];
    there_first += std::pow(scale * errors.to_model[i], 2);
    back += errors.stretch[i] * std::pow(std::min(to_shape, found[k]), 2);
    back_first += errors.stretch[i] * to_shape * to_shape;
    weights += errors.stretch[i];
  }
  if (!sample.empty() && there_first > 0 && weights > 0) {
    const auto n = static_cast<double>(sample.size());
    result.rms_ratio = std::sqrt(std::max(there / n, back / weights) /
                                 std::max(there_first / n, back_first / weights));
  }

  const double most_first = scale * values[worst[0]];
  double most = 0;
  for (std::size_t begin = 0; begin < worst.size(); begin += kBatch) {
    if (scale * values[worst[begin]] <= most) break;
    const std::size_t end = std::min(worst.size(), begin + kBatch);
    const auto at = worst.begin();
    most = std::max(most, largest(distances({at + static_cast<std::ptrdiff_t>(begin),
                                             at + static_cast<std::ptrdiff_t>(end)})));
  }
  if (most_first > 0) result.max_ratio = most / most_first;
  return result;
}

}  // namespace rholm
