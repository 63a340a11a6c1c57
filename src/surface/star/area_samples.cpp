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

// Up to and with each triangle.
std::vector<double> cumulative_areas(const Mesh& mesh) {
  std::vector<double> sums;
  sums.reserve(mesh.triangles.size());
  AreaSum sum(unit_frame(bounds(mesh.vertices)).scale);
  CancelPoll poll;
  for (const Triangle& t : mesh.triangles) {
    poll();
    sums.push_back(sum.add(mesh, t));
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

double AreaSum::add(const Mesh& mesh, const Triangle& t) {
  const FaceNormal face = face_normal(scaled_corners(mesh, t, scale_));
  if (!face.degenerate) sum_.add(norm(face.twice_area));
  largest_ = std::max(largest_, sum_.value());  // rounding might take it back
  return largest_;
}

double AreaSampling::target(std::size_t k) const {
  return (static_cast<double>(k) + random_uniform(seed, 3 * k)) * share;
}

Vec3 AreaSampling::place(std::size_t k, const Mesh& mesh, const Triangle& t) const {
  return point_of_triangle(mesh, t, random_uniform(seed, 3 * k + 1),
                           random_uniform(seed, 3 * k + 2));
}

void check_area(double area, std::size_t n_triangles) {
  if (area > 0) return;
  throw Error(ErrorCode::kInvalidInput,
              "a surface of area 0 (" + std::to_string(n_triangles) +
                  " triangles) cannot be sampled; give a mesh with a triangle of positive area");
}

AreaSampler::AreaSampler(const Mesh& mesh, std::size_t n, std::uint64_t seed)
    : mesh_(mesh), n_(n), seed_(seed), sums_(cumulative_areas(mesh)) {
  check_area(sums_.empty() ? 0 : sums_.back(), mesh.triangles.size());
}

AreaSamples AreaSampler::range(std::size_t first, std::size_t count) const {
  AreaSamples samples;
  samples.points.reserve(count);
  samples.triangles.reserve(count);
  const AreaSampling sampling{.share = sums_.back() / static_cast<double>(n_), .seed = seed_};
  // The first triangle whose sum exceeds the target has area. Rounding may lift the last target to
  // the total: that belongs to the last triangle with area.
  const auto last = std::lower_bound(sums_.begin(), sums_.end(), sums_.back());
  auto triangle =
      std::upper_bound(sums_.begin(), last, static_cast<double>(first) * sampling.share);
  CancelPoll poll;
  for (std::size_t k = first; k < first + count; ++k) {
    poll();
    const double target = sampling.target(k);
    while (triangle != last && *triangle <= target) ++triangle;
    const auto t = static_cast<std::size_t>(triangle - sums_.begin());
    samples.triangles.push_back(static_cast<std::uint32_t>(t));
    samples.points.push_back(sampling.place(k, mesh_, mesh_.triangles[t]));
  }
  return samples;
}

AreaSamples sample_by_area(const Mesh& mesh, std::size_t n, std::uint64_t seed) {
  return AreaSampler(mesh, n, seed).range(0, n);
}

}  // namespace rholm
