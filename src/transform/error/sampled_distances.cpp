#include "transform/error/sampled_distances.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shape/queries/near_faces.h"
#include "shape/queries/triangle_tree.h"
#include "transform/error/closest_distances.h"
#include "transform/error/proportional_sample.h"

namespace rholm {
namespace {

// Size of the sample. It leaves an error of 0.05 % of the rms on asteroids, and 2 % on shapes with
// large steep faces (scripts/measure-distances).
constexpr std::size_t kSample = 1000;
// Each step from the model's point on the ray is of second order. Two steps leave 1e-5 of the rms
// on asteroids, but 2 % of the largest distance, where surfaces are farthest apart and bent.
// Largest distances take eight steps (scripts/measure-distances).
constexpr int kSteps = 2, kMoreSteps = 8;
// Number of points with the largest errors to first order. The farthest point is among them
// (chosen).
constexpr std::size_t kMostWorstPoints = 2048;
// More steps are worth while for distances of at least this part of the largest one.
constexpr double kNearlyLargest = 0.8;
constexpr double kMostError = 0.005, kFar = 0.1;
constexpr std::size_t kFewFaces = 1000;
constexpr std::uint64_t kSeed = 3;

const Context kAlone{.threads = 1};  // waking threads takes longer than a few thousand points

double square(double x) { return x * x; }

double scale_of(const ErrorPoints& points) {
  return std::exp2(-std::ilogb(std::max(largest(points.radii), 1e-300)));
}

std::vector<double> steps_to_model(const RadialModel& model, const ErrorPoints& points, int steps) {
  const double scale = scale_of(points);
  std::vector<Vec3> x(points.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = scale * points.radii[i] * points.directions[i];
  std::vector<double> distances =
      RadialSurface(model, scale, kAlone).distances(x, points.directions, steps);
  for (double& distance : distances) distance /= scale;
  return distances;
}

// Returns the distances to the mesh of the model's points on the rays of some points. The mesh is
// no farther than the points.
std::vector<double> distances_to_mesh(const MeshView& mesh, const Vec3& center,
                                      const RadialModel& model, const ErrorPoints& points,
                                      const Context& context) {
  const double scale = scale_of(points);
  Balls balls{.centers = RadialSurface(model, scale, kAlone).points(points.directions),
              .radii = {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    balls.radii.push_back(norm(balls.centers[i] - scale * points.radii[i] * points.directions[i]));
  }
  const Mesh near = faces_near(mesh, center, scale, balls, context);
  const TriangleTree tree(near);
  std::vector<double> distances;
  for (const ClosestPoint& closest : tree.closest(balls.centers)) {
    distances.push_back(closest.distance / scale);
  }
  return distances;
}

// Distances to first order are measured at all points. Closest points of a sample correct them: sum
// d^2 = sum d_1^2 + sum (d^2 - d_1^2). No distance is above the radial error. With chances in
// proportion to the square of that error, no sample point counts for more than its share.
struct Sums {
  ProportionalSample sample;
  CorrectedSum there, back;
  double model_area = 0;  // sum of the stretch of all points

  explicit Sums(const PointErrors& errors) {
    std::vector<double> weights(errors.radial.size());
    for (std::size_t i = 0; i < weights.size(); ++i) {
      there.first += square(errors.to_model[i]);
      back.first += errors.stretch[i] * square(errors.to_shape[i]);
      model_area += errors.stretch[i];
      weights[i] = (1 + errors.stretch[i]) * square(errors.radial[i]);
    }
    sample = proportional_sample(weights, kSample, kSeed);
  }

  void correct(const PointErrors& errors, const std::vector<double>& to_model,
               const std::vector<double>& to_mesh) {
    for (std::size_t k = 0; k < sample.indices.size(); ++k) {
      const std::size_t i = sample.indices[k];
      there.add(sample.stand_for[k] * (square(to_model[k]) - square(errors.to_model[i])));
      back.add(sample.stand_for[k] * errors.stretch[i] *
               (square(to_mesh[k]) - square(errors.to_shape[i])));
    }
  }
};

// Returns, for each point, the distance to the model if it may be the largest, else 0.
std::vector<double> largest_to_model(const RadialModel& model, const MeasuredPoints& worst) {
  std::vector<double> distances(worst.points.size());
  const auto measure = [&](const std::vector<std::size_t>& indices, int steps) {
    const std::vector<double> found = steps_to_model(model, worst.points.subset(indices), steps);
    for (std::size_t k = 0; k < found.size(); ++k) distances[indices[k]] = found[k];
  };
  measure(indices_of_largest(worst.errors.to_model, kMostWorstPoints), kSteps);
  const double least = kNearlyLargest * largest(distances);
  std::vector<std::size_t> nearly;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (distances[i] > 0 && distances[i] >= least) nearly.push_back(i);
  }
  measure(nearly, kMoreSteps);
  return distances;
}

// Returns the points whose model points may be farther from the mesh than `most`.
std::vector<std::size_t> farther_back(const PointErrors& errors, double most) {
  std::vector<double> to_shape = errors.to_shape;
  for (std::size_t i = 0; i < to_shape.size(); ++i) {
    if (!(errors.radial[i] > most)) to_shape[i] = 0;
  }
  return largest(to_shape) > 0 ? indices_of_largest(to_shape, kMostWorstPoints)
                               : std::vector<std::size_t>{};
}

}  // namespace

std::vector<double> distances_to_model(const RadialModel& model, const ErrorPoints& points) {
  return steps_to_model(model, points, kMoreSteps);
}

bool SampledDistances::suffice(const MeshView& mesh) const {
  return mesh.n_faces > kFewFaces && rms_error <= kMostError && std::abs(ratio - 1) <= kFar;
}

SampledDistances sampled_distances(const MeshView& mesh, const Vec3& center,
                                   const RadialModel& model, const MeasuredPoints& over_area,
                                   const MeasuredPoints& worst, const Context& context) {
  Sums sums(over_area.errors);
  const std::vector<std::size_t>& indices = sums.sample.indices;
  SampledDistances result{.to_model = largest_to_model(model, worst)};
  result.max = largest(result.to_model);
  // All distances back are computed at once, because the search for the faces takes longest.
  ErrorPoints points = over_area.points.subset(indices);
  const std::vector<double> to_model = steps_to_model(model, points, kSteps);
  points.append(worst.points.subset(farther_back(worst.errors, result.max)));
  if (points.size() == 0) return result;
  const std::vector<double> to_mesh = distances_to_mesh(mesh, center, model, points, context);
  for (std::size_t k = indices.size(); k < to_mesh.size(); ++k) {
    result.max = std::max(result.max, to_mesh[k]);
  }
  sums.correct(over_area.errors, to_model, to_mesh);
  const CorrectedSum &there = sums.there, &back = sums.back;
  const double mean_there = there.value() / static_cast<double>(over_area.points.size());
  const double mean_back = sums.model_area > 0 ? back.value() / sums.model_area : 0;
  result.rms = std::sqrt(std::max(mean_there, mean_back));
  result.rms_error = (mean_there >= mean_back ? there : back).error(indices.size());
  if (there.first > 0) result.ratio = std::sqrt(there.value() / there.first);
  return result;
}

}  // namespace rholm
