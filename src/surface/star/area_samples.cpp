#include "surface/star/area_samples.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/cancel.h"
#include "base/compensated_sum.h"
#include "base/random.h"
#include "rholm/error.h"
#include "shape/face.h"

namespace rholm {
namespace {

// Twice the area of all triangles up to and with each; triangles without a direction count as 0,
// so that every sample has a normal.
std::vector<double> cumulative_areas(const Mesh& mesh) {
  std::vector<double> sums;
  sums.reserve(mesh.triangles.size());
  CompensatedSum sum;
  const double scale = unit_frame(bounds(mesh.vertices)).scale;  // areas of any unit in range
  CancelPoll poll;
  for (const Triangle& t : mesh.triangles) {
    poll();
    const FaceNormal face = face_normal(scaled_corners(mesh, t, scale));
    if (!face.degenerate) sum.add(norm(face.twice_area));
    sums.push_back(sum.value());
  }
  return sums;
}

// Uniform over the triangle: with sqrt(u) the density grows like the width seen from corner 0.
Vec3 point_of_triangle(const Mesh& mesh, const Triangle& t, double u, double v) {
  const double root = std::sqrt(u);
  return (1 - root) * mesh.vertices[t[0]] + (root * (1 - v)) * mesh.vertices[t[1]] +
         (root * v) * mesh.vertices[t[2]];
}

}  // namespace

AreaSamples sample_by_area(const Mesh& mesh, std::size_t n, std::uint64_t seed) {
  const std::vector<double> sums = cumulative_areas(mesh);
  if (sums.empty() || !(sums.back() > 0)) {
    throw Error(ErrorCode::kInvalidInput,
                "a surface of area 0 (" + std::to_string(mesh.triangles.size()) +
                    " triangles) cannot be sampled; give a mesh with a triangle of positive area");
  }
  AreaSamples samples;
  samples.points.reserve(n);
  samples.triangles.reserve(n);
  std::size_t triangle = 0;
  const double share = sums.back() / static_cast<double>(n);
  CancelPoll poll;
  for (std::size_t k = 0; k < n; ++k) {
    poll();
    const double target = (static_cast<double>(k) + random_uniform(seed, 3 * k)) * share;
    // The first triangle whose sum exceeds the target has area. Rounding may lift the last
    // target to the total: that belongs to the last triangle with area.
    while (sums[triangle] <= target && sums[triangle] < sums.back()) ++triangle;
    samples.triangles.push_back(static_cast<std::uint32_t>(triangle));
    samples.points.push_back(point_of_triangle(mesh, mesh.triangles[triangle],
                                               random_uniform(seed, 3 * k + 1),
                                               random_uniform(seed, 3 * k + 2)));
  }
  return samples;
}

}  // namespace rholm
