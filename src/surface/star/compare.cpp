#include "rholm/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>

#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "shape/face.h"
#include "shape/queries/triangle_tree.h"
#include "surface/star/area_samples.h"

namespace rholm {
namespace {

constexpr std::size_t kGrain =
    256;  // queries of a chunk: some 50 ms where the shapes are far apart

constexpr std::size_t kNormalGrain = 1024;  // triangles of a chunk: 0.1 ms

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

// Of unit length; zero for a triangle that is degenerate, which has none.
std::vector<Vec3> unit_normals(const Mesh& mesh, const Context& context) {
  std::vector<Vec3> normals(mesh.triangles.size());
  parallel_for(normals.size(), kNormalGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const FaceNormal face = face_normal(scaled_corners(mesh, mesh.triangles[t], 1));
      if (!face.degenerate) normals[t] = normalized(face.twice_area);
    }
  });
  return normals;
}

// A mesh to measure from and to.
struct Side {
  const Mesh& mesh;
  TriangleTree tree;
  std::vector<Vec3> normals;
  Side(const Mesh& m, const Context& context)
      : mesh(m), tree(m), normals(unit_normals(m, context)) {}
};

struct OneSided {
  std::vector<double> distances;
  std::vector<double> angles;  // negative: the closest triangle is degenerate, it has no normal
};

OneSided measure_one_sided(const Side& from, const Side& to, const CompareOptions& options,
                           const Context& context, const ParallelStage& stage) {
  const AreaSamples samples = sample_by_area(from.mesh, options.samples, options.seed);
  OneSided result{std::vector<double>(options.samples), std::vector<double>(options.samples)};
  parallel_for(options.samples, kGrain, context, stage, [&](std::size_t begin, std::size_t end) {
    const std::vector<ClosestPoint> closest =
        to.tree.closest(std::span(samples.points).subspan(begin, end - begin));
    for (std::size_t k = begin; k < end; ++k) {
      const Vec3& there = to.normals[closest[k - begin].triangle];
      result.distances[k] = closest[k - begin].distance;
      result.angles[k] =
          there == Vec3{} ? -1 : angle_degrees(from.normals[samples.triangles[k]], there);
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
  const Side side_a(mesh_a, context), side_b(mesh_b, context);
  const OneSided forth = measure_one_sided(side_a, side_b, options, context, {"compare", 0, 0.5});
  const OneSided back = measure_one_sided(side_b, side_a, options, context, {"compare", 0.5, 1});
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
  const TriangleTree tree(surface);
  std::vector<double> distances(points.size());
  parallel_for(points.size(), kGrain, context, {"distances"},
               [&](std::size_t begin, std::size_t end) {
                 std::size_t k = begin;
                 for (const ClosestPoint& closest :
                      tree.closest(std::span(points).subspan(begin, end - begin))) {
                   distances[k++] = closest.distance;
                 }
               });
  return distances;
}

}  // namespace rholm
