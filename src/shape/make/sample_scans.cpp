#include "shape/make/sample_scans.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "shape/make/sample_pattern.h"

namespace rholm {
namespace {

using std::numbers::pi;

// Chosen: as far as a scanner on a tripod, so that it sees most of a side.
constexpr double kDistance = 3;  // of the radius
constexpr std::uint64_t kScannerStream = std::uint64_t{1} << 63;
constexpr int kMostTries = 1000;  // for a place that is seen
// Of the distance: a ray that ends so near before a place has met its surface.
constexpr double kNear = 1e-5;
// Of the field: what fills less gets fewer points rather than so many more rays.
constexpr double kLeastSeen = 0.005;
constexpr std::size_t kProbes = 64;  // a side, to find how much of its field a scanner sees

// Spread evenly over the sphere, along a spiral.
Vec3 on_spiral(std::size_t i, std::size_t n) {
  const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
  const double phi = static_cast<double>(i) * pi * (3 - std::sqrt(5.0));
  const double s = std::sqrt(1 - z * z);
  return {s * std::cos(phi), s * std::sin(phi), z};
}

double mean_square_distance(const SampledSurface& surface) {
  double sum = 0;
  for (std::size_t t = 0; t < surface.mesh().triangles.size(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    const Vec3 from = (a + b + c) / 3 - surface.middle();
    sum += norm(surface.twice_area(t)) / 2 * dot(from, from);
  }
  return sum / surface.area();
}

}  // namespace

Scans::Scans(const SampledSurface& surface, const SampleOptions& options)
    : surface_(surface), options_(options) {
  for (const Vec3& vertex : surface.mesh().vertices) {
    local_.vertices.push_back(surface.frame().to_local(vertex));
    radius_ = std::max(radius_, norm(local_.vertices.back() - surface.middle()));
  }
  local_.triangles = surface.mesh().triangles;
  scene_.emplace(local_);
  // Half of the mean square by shifts, 3 s^2, half by turns, 2 s^2 |x|^2.
  const double half = 0.5 * std::pow(options.misalignment * surface.diagonal(), 2);
  const double shift = std::sqrt(half / 3);
  const double turn = std::sqrt(half / (2 * mean_square_distance(surface)));
  const auto n = static_cast<std::size_t>(options.scans);
  for (std::size_t k = 0; k < n; ++k) {
    RandomStream random(options.seed, kScannerStream + k);
    RandomStream common(options.seed, kScannerStream + n);
    const RigidMotion whole{.middle = {}, .shift = {}, .turn = pi * common.direction()};
    const double part = n > 1 ? static_cast<double>(k) / static_cast<double>(n - 1) : 0;
    scanners_.push_back(
        {.at = surface.middle() + kDistance * radius_ * whole.direction(on_spiral(k, n)),
         .motion = {surface.middle(), shift * random.gaussian(), turn * random.gaussian()},
         .noise = options.noise + part * options.scan_noise});
  }
}

bool Scans::sees(const Scanner& scanner, const SurfacePlace& place) const {
  const Vec3 ray = place.point - scanner.at;
  const double distance = norm(ray);
  return !scene_->occluded(scanner.at, ray / distance, 0, (1 - kNear) * distance);
}

std::optional<SurfacePlace> Scans::draw(std::size_t scan, RandomStream& random) const {
  const Scanner& scanner = scanners_[scan];
  for (int k = 0; k < kMostTries; ++k) {
    const SurfacePlace place = surface_.draw(random);
    // So many rays meet an area at that angle.
    const double cosine = std::abs(dot(normalized(scanner.at - place.point), place.normal));
    if (random.uniform() < cosine && sees(scanner, place)) return place;
  }
  return {};
}

std::vector<SurfacePlace> Scans::lines(std::size_t scan, const Context& context) const {
  const Scanner& scanner = scanners_[scan];
  const Vec3 forward = normalized(surface_.middle() - scanner.at);
  const Vec3 axis = pattern_frame(options_).axis;
  // Lines run across the axis, unless the scanner looks along it.
  const Vec3 beside = cross(forward, axis);
  const Vec3 along = norm(beside) > 0.1 ? normalized(beside) : pattern_frame(options_).u;
  const Vec3 up = cross(along, forward);
  const double half = std::sqrt(1 / (kDistance * kDistance - 1));  // tangent of the ball's angle
  const auto shoot = [&](double x, double y) {
    const Vec3 direction = normalized(forward + half * (x * along + y * up));
    const RayHit hit = scene_->first_hit(scanner.at, direction, 0, 2 * kDistance * radius_);
    return hit.hit ? std::optional(hit) : std::nullopt;
  };
  const auto middle_of = [](std::size_t i, std::size_t n) {
    return 2 * (static_cast<double>(i) + 0.5) / static_cast<double>(n) - 1;
  };
  std::size_t hits = 0;
  for (std::size_t i = 0; i < kProbes * kProbes; ++i) {
    hits += shoot(middle_of(i % kProbes, kProbes), middle_of(i / kProbes, kProbes)).has_value();
  }
  const double share = std::max(kLeastSeen, static_cast<double>(hits) / (kProbes * kProbes));
  const double rays = static_cast<double>(options_.points) / options_.scans / share;
  const auto count = [](double n) {
    return static_cast<std::size_t>(std::max(1.0, std::round(n)));
  };
  const std::size_t n_lines = count(std::sqrt(rays / options_.pattern_ratio));
  const std::size_t n_along = count(rays / static_cast<double>(n_lines));
  std::vector<std::vector<SurfacePlace>> found(n_lines);
  parallel_for(n_lines, 8, context, {.name = "sample"}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t line = begin; line < end; ++line) {
      for (std::size_t i = 0; i < n_along; ++i) {
        const auto hit = shoot(middle_of(i, n_along), middle_of(line, n_lines));
        if (!hit || surface_.twice_area(hit->triangle) == Vec3{}) continue;
        const double u = std::clamp(static_cast<double>(hit->u), 0.0, 1.0);
        const double v = std::clamp(static_cast<double>(hit->v), 0.0, 1 - u);
        found[line].push_back(surface_.place(hit->triangle, {1 - u - v, u, v}));
      }
    }
  });
  std::vector<SurfacePlace> all;
  for (auto& places : found) all.insert(all.end(), places.begin(), places.end());
  return all;
}

}  // namespace rholm
