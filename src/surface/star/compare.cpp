#include "rholm/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/face.h"
#include "shape/queries/ray_scene.h"
#include "surface/star/area_samples.h"

namespace rholm {
namespace {

constexpr std::size_t kGrain =
    256;  // queries of a chunk: some 50 ms where the shapes are far apart

void check(const CompareOptions& options) {
  if (options.samples == 0 || options.samples > kMaxSamples) {
    throw Error(ErrorCode::kInvalidInput, "samples is " + std::to_string(options.samples) +
                                              ", it must be 1 ... " + std::to_string(kMaxSamples));
  }
  if (!(options.threshold > 0) || !std::isfinite(options.threshold)) {
    throw Error(ErrorCode::kInvalidInput, "threshold is " + std::to_string(options.threshold) +
                                              ", it must be a positive fraction of the diagonal");
  }
}

// The power of two that brings both shapes to the order of 1, so that squares can be formed.
double common_scale(const Mesh& a, const Mesh& b) {
  const Bounds of_a = bounds(a.vertices), of_b = bounds(b.vertices);
  return unit_frame(bounds({of_a.min, of_a.max, of_b.min, of_b.max})).scale;
}

Mesh scaled(const Mesh& mesh, double scale) {
  Mesh result{mesh.vertices, mesh.triangles, {}};
  for (Vec3& vertex : result.vertices) vertex *= scale;
  return result;
}

double angle_degrees(const Vec3& a, const Vec3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b)) * (180 / std::numbers::pi);
}

struct OneSided {
  std::vector<double> distances;
  std::vector<double> angles;  // negative: the closest triangle is degenerate, it has no normal
};

OneSided measure_one_sided(const Mesh& from, const RayScene& scene, const Mesh& to,
                           const CompareOptions& options, const Context& context,
                           const ParallelStage& stage) {
  const AreaSamples samples = sample_by_area(from, options.samples, options.seed);
  OneSided result{std::vector<double>(options.samples), std::vector<double>(options.samples)};
  parallel_for(options.samples, kGrain, context, stage, [&](std::size_t begin, std::size_t end) {
    std::uint32_t likely = RayScene::kAny;  // samples are in the order of the faces
    for (std::size_t k = begin; k < end; ++k) {
      const ClosestPoint closest = scene.closest(samples.points[k], likely);
      likely = closest.triangle;
      const Triangle& here = from.triangles[samples.triangles[k]];
      const FaceNormal face = face_normal(scaled_corners(to, to.triangles[closest.triangle], 1));
      const FaceNormal own = face_normal(scaled_corners(from, here, 1));
      result.distances[k] = closest.distance;
      result.angles[k] =
          face.degenerate ? -1
                          : angle_degrees(normalized(own.twice_area), normalized(face.twice_area));
    }
  });
  return result;
}

Distances summarize(const std::vector<double>& distances, double unit) {
  CompensatedSum sum, squares;
  double max = 0;
  for (const double d : distances) {
    sum.add(d);
    squares.add(d * d);
    max = std::max(max, d);
  }
  const auto n = static_cast<double>(distances.size());
  return {std::sqrt(squares.value() / n) * unit, sum.value() / n * unit, max * unit};
}

double share_within(const std::vector<double>& distances, double threshold) {
  const auto n =
      std::count_if(distances.begin(), distances.end(), [&](double d) { return d <= threshold; });
  return static_cast<double>(n) / static_cast<double>(distances.size());
}

// The middle value, or the mean of the two middle ones; 0 for none.
double median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

void summarize_angles(std::vector<double> angles, const std::vector<double>& more,
                      Comparison& result) {
  angles.insert(angles.end(), more.begin(), more.end());
  std::erase_if(angles, [](double angle) { return angle < 0; });
  CompensatedSum sum;
  for (const double angle : angles) sum.add(angle);
  if (!angles.empty())
    result.normal_mean_degrees = sum.value() / static_cast<double>(angles.size());
  result.normal_median_degrees = median(angles);
}

}  // namespace

Comparison compare(const Mesh& a, const Mesh& b, const CompareOptions& options,
                   const Context& context) {
  check(options);
  validate(a);
  validate(b);
  const double scale = common_scale(a, b);
  const Mesh mesh_a = scaled(a, scale), mesh_b = scaled(b, scale);
  const RayScene scene_a(mesh_a), scene_b(mesh_b);
  const OneSided forth =
      measure_one_sided(mesh_a, scene_b, mesh_b, options, context, {"compare", 0, 0.5});
  const OneSided back =
      measure_one_sided(mesh_b, scene_a, mesh_a, options, context, {"compare", 0.5, 1});
  const double diagonal = bounds(mesh_a.vertices).diagonal();
  Comparison result;
  result.samples = options.samples;
  result.seed = options.seed;
  result.diagonal = diagonal / scale;
  result.a_to_b = summarize(forth.distances, 1 / scale);
  result.b_to_a = summarize(back.distances, 1 / scale);
  result.hausdorff = std::max(result.a_to_b.max, result.b_to_a.max);
  result.threshold = options.threshold * diagonal / scale;
  result.recall = share_within(forth.distances, options.threshold * diagonal);
  result.precision = share_within(back.distances, options.threshold * diagonal);
  const double sum = result.precision + result.recall;
  if (sum > 0) result.f_score = 2 * result.precision * result.recall / sum;
  summarize_angles(forth.angles, back.angles, result);
  return result;
}

std::vector<double> distances_to_surface(const std::vector<Vec3>& points, const Mesh& surface,
                                         const Context& context) {
  validate(surface);
  const RayScene scene(surface);
  std::vector<double> distances(points.size());
  parallel_for(points.size(), kGrain, context, {"distances"},
               [&](std::size_t begin, std::size_t end) {
                 std::uint32_t likely = RayScene::kAny;
                 for (std::size_t k = begin; k < end; ++k) {
                   const ClosestPoint closest = scene.closest(points[k], likely);
                   distances[k] = closest.distance;
                   likely = closest.triangle;
                 }
               });
  return distances;
}

}  // namespace rholm
