#include "shape/make/surface_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/cancel.h"
#include "base/compensated_sum.h"
#include "base/random.h"

namespace rholm {
namespace {

using std::numbers::pi;

constexpr double kBoxGrowth = 1.1;  // factor of the box of outliers

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, std::uint64_t number)
    : seed_(random_bits(seed, number)) {}

double RandomStream::uniform() { return random_uniform(seed_, counter_++); }

// Returns two independent standard normal deviates (Box and Muller 1958).
std::pair<double, double> RandomStream::gaussian_pair() {
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));  // 1 - u is never 0
  const double angle = 2 * pi * uniform();
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

Vec3 RandomStream::gaussian() {
  const auto [x, y] = gaussian_pair();
  return {x, y, gaussian_pair().first};
}

Vec3 RandomStream::direction() {
  const double z = 2 * uniform() - 1, phi = 2 * pi * uniform();
  const double s = std::sqrt(1 - z * z);
  return {s * std::cos(phi), s * std::sin(phi), z};
}

SampledSurface::SampledSurface(const Mesh& mesh, double density_ratio) : mesh_(mesh) {
  const Bounds box = bounds(mesh.vertices);
  frame_ = unit_frame(box);
  low_ = frame_.to_local(box.min);
  size_ = frame_.to_local(box.max) - low_;
  const bool along_x = size_.x >= size_.y && size_.x >= size_.z;
  const Vec3 axis = along_x ? Vec3{1, 0, 0} : size_.y >= size_.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  falloff_ = std::log(density_ratio) / dot(size_, axis) * axis;
  CompensatedSum sum;
  sums_.reserve(mesh.faces.size());
  CancelPoll poll;
  for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
    poll();
    sum.add(norm(twice_area(t)));
    sums_.push_back(sum.value());
  }
}

std::array<Vec3, 3> SampledSurface::corners(std::size_t triangle) const {
  const Triangle& t = mesh_.faces[triangle];
  return {frame_.to_local(mesh_.vertices[t[0]]), frame_.to_local(mesh_.vertices[t[1]]),
          frame_.to_local(mesh_.vertices[t[2]])};
}

Vec3 SampledSurface::twice_area(std::size_t triangle) const {
  const FaceNormal face = face_normal(scaled_corners(mesh_, mesh_.faces[triangle], frame_.scale));
  return face.degenerate ? Vec3{} : face.twice_area;
}

SurfacePlace SampledSurface::place(std::size_t triangle, const std::array<double, 3>& w) const {
  const auto [a, b, c] = corners(triangle);
  return {.point = w[0] * a + w[1] * b + w[2] * c,
          .normal = normalized(twice_area(triangle)),
          .triangle = triangle,
          .weights = w};
}

SurfacePlace SampledSurface::draw_uniform(RandomStream& random) const {
  const double target = random.uniform() * sums_.back();
  // The first triangle whose sum exceeds the target has area. Rounding may raise the target to the
  // total, which belongs to the last triangle with area.
  auto found = std::upper_bound(sums_.begin(), sums_.end(), target);
  if (found == sums_.end()) found = std::lower_bound(sums_.begin(), sums_.end(), sums_.back());
  // With sqrt(u), the density grows like the width seen from corner 0.
  const double root = std::sqrt(random.uniform()), v = random.uniform();
  return place(static_cast<std::size_t>(found - sums_.begin()),
               {1 - root, root * (1 - v), root * v});
}

SurfacePlace SampledSurface::draw(RandomStream& random) const {
  SurfacePlace place = draw_uniform(random);
  while (!keeps(place, random)) place = draw_uniform(random);
  return place;
}

bool SampledSurface::keeps(const SurfacePlace& place, RandomStream& random) const {
  return random.uniform() < std::exp(-dot(falloff_, place.point - low_));
}

SurfacePlace SampledSurface::draw_outlier(RandomStream& random) const {
  const Vec3 u{random.uniform(), random.uniform(), random.uniform()};
  const auto spread = [](double size, double x) { return kBoxGrowth * size * (x - 0.5); };
  const Vec3 offset{spread(size_.x, u.x), spread(size_.y, u.y), spread(size_.z, u.z)};
  const Vec3 normal = random.direction();
  // An outlier is not on the surface: it has the attributes of a random place.
  SurfacePlace place = draw_uniform(random);
  place.point = middle() + offset;
  place.normal = normal;
  return place;
}

}  // namespace rholm
