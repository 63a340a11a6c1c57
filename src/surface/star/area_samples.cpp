#include "surface/star/area_samples.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/cancel.h"
#include "base/random.h"
#include "rholm/error.h"
#include "shape/face.h"

namespace rholm {
namespace {

// Uniform in the triangle: with sqrt(u) the density grows like the width seen from corner 0.
Vec3 point_of_triangle(const Mesh& mesh, const Triangle& t, double u, double v) {
  const double root = std::sqrt(u);
  return (1 - root) * mesh.vertices[t[0]] + (root * (1 - v)) * mesh.vertices[t[1]] +
         (root * v) * mesh.vertices[t[2]];
}

}  // namespace

std::vector<double> AreaSum::add(const Mesh& part) {
  std::vector<double> sums;
  sums.reserve(part.faces.size());
  CancelPoll poll;
  for (const Triangle& t : part.faces) {
    poll();
    const FaceNormal face = face_normal(scaled_corners(part, t, scale_));
    if (!face.degenerate) sum_.add(norm(face.twice_area));
    largest_ = std::max(largest_, sum_.value());  // rounding might decrease the sum
    sums.push_back(largest_);
  }
  return sums;
}

void check_area(double area, std::size_t n_faces) {
  if (area > 0) return;
  throw Error(ErrorCode::kInvalidInput,
              "a surface of area 0 (" + std::to_string(n_faces) +
                  " faces) cannot be sampled; give a mesh with a face of positive area");
}

AreaSamples AreaSampling::draw(const Mesh& part, std::span<const double> sums, std::size_t first,
                               std::size_t count) const {
  AreaSamples samples;
  samples.points.reserve(count);
  samples.faces.reserve(count);
  const double share = twice_area / static_cast<double>(n);
  // The first triangle whose sum exceeds the target has positive area. Rounding may
  // lift the last target to the total; it then belongs to the last triangle with area.
  const auto last = std::lower_bound(sums.begin(), sums.end(), twice_area);
  auto triangle = std::upper_bound(sums.begin(), last, static_cast<double>(first) * share);
  CancelPoll poll;
  for (std::size_t k = first; k < first + count; ++k) {
    poll();
    const double target = (static_cast<double>(k) + random_uniform(seed, 3 * k)) * share;
    while (triangle != last && *triangle <= target) ++triangle;
    if (triangle == sums.end()) break;
    const auto t = static_cast<std::size_t>(triangle - sums.begin());
    samples.faces.push_back(static_cast<std::uint32_t>(t));
    samples.points.push_back(point_of_triangle(part, part.faces[t], random_uniform(seed, 3 * k + 1),
                                               random_uniform(seed, 3 * k + 2)));
  }
  return samples;
}

AreaSamples sample_by_area(const Mesh& mesh, std::size_t n, std::uint64_t seed) {
  AreaSum sum(unit_frame(bounds(mesh.vertices)).scale);
  const std::vector<double> sums = sum.add(mesh);
  check_area(sum.value(), mesh.faces.size());
  return AreaSampling{sum.value(), n, seed}.draw(mesh, sums, 0, n);
}

}  // namespace rholm
