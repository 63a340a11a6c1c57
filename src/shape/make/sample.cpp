// Random points on a surface. Every point has a stream of random numbers of its own, so that the
// points do not depend on threads, nor on how many numbers another one took.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "base/cancel.h"
#include "base/compensated_sum.h"
#include "base/parallel.h"
#include "base/random.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "shape/face.h"

namespace rholm {
namespace {

using std::numbers::pi;

constexpr std::size_t kGrain = 4096;                      // points per chunk; chosen: some 0.5 ms
constexpr double kBoxGrowth = 1.1;                        // of the box of outliers
constexpr std::uint64_t kHoleStream = ~std::uint64_t{0};  // no point has this number

// The numbers of one point.
class Stream {
 public:
  Stream(std::uint64_t seed, std::uint64_t point) : seed_(random_bits(seed, point)) {}
  double uniform() { return random_uniform(seed_, counter_++); }
  // Two independent standard normal deviates (Box and Muller 1958).
  std::pair<double, double> gaussian_pair() {
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));  // 1 - u is never 0
    const double angle = 2 * pi * uniform();
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }
  Vec3 gaussian() {
    const auto [x, y] = gaussian_pair();
    return {x, y, gaussian_pair().first};
  }
  Vec3 direction() {
    const double z = 2 * uniform() - 1, phi = 2 * pi * uniform();
    const double s = std::sqrt(1 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
  }

 private:
  std::uint64_t seed_;
  std::uint64_t counter_ = 0;
};

struct Place {
  Vec3 point;
  Vec3 normal;
  std::size_t triangle = 0;            // whose attributes it has
  std::array<double, 3> weights = {};  // of its corners
};

// The surface in its unit frame, ready to be drawn from.
class Surface {
 public:
  Surface(const Mesh& mesh, double density_ratio)
      : mesh_(mesh), bounds_(bounds(mesh.vertices)), frame_(unit_frame(bounds_)) {
    low_ = frame_.to_local(bounds_.min);
    size_ = frame_.to_local(bounds_.max) - low_;
    const bool along_x = size_.x >= size_.y && size_.x >= size_.z;
    const Vec3 axis = along_x ? Vec3{1, 0, 0} : size_.y >= size_.z ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    falloff_ = std::log(density_ratio) / dot(size_, axis) * axis;
    CompensatedSum sum;
    sums_.reserve(mesh.triangles.size());
    CancelPoll poll;
    for (const Triangle& t : mesh.triangles) {
      poll();
      const FaceNormal face = face_normal(scaled_corners(mesh_, t, frame_.scale));
      // Triangles without a direction count as 0, so that every point has a normal.
      if (!face.degenerate) sum.add(norm(face.twice_area));
      sums_.push_back(sum.value());
    }
  }

  bool has_area() const { return !sums_.empty() && sums_.back() > 0; }
  const UnitFrame& frame() const { return frame_; }
  double diagonal() const { return norm(size_); }

  // Uniform by area.
  Place draw_uniform(Stream& random) const {
    const double target = random.uniform() * sums_.back();
    // The first triangle whose sum exceeds the target has area. Rounding may lift the target to
    // the total: that belongs to the last triangle with area.
    auto found = std::upper_bound(sums_.begin(), sums_.end(), target);
    if (found == sums_.end()) found = std::lower_bound(sums_.begin(), sums_.end(), sums_.back());
    const auto triangle = static_cast<std::size_t>(found - sums_.begin());
    const Triangle& t = mesh_.triangles[triangle];
    // With sqrt(u) the density grows like the width seen from corner 0.
    const double root = std::sqrt(random.uniform()), v = random.uniform();
    const std::array<double, 3> w{1 - root, root * (1 - v), root * v};
    const auto corner = [&](int k) { return frame_.to_local(mesh_.vertices[t[k]]); };
    return {.point = w[0] * corner(0) + w[1] * corner(1) + w[2] * corner(2),
            .normal = normalized(face_normal(scaled_corners(mesh_, t, frame_.scale)).twice_area),
            .triangle = triangle,
            .weights = w};
  }

  // Uniform by area, thinned by the law of density: on average at most density_ratio tries.
  Place draw(Stream& random) const {
    Place place = draw_uniform(random);
    while (random.uniform() >= std::exp(-dot(falloff_, place.point - low_))) {
      place = draw_uniform(random);
    }
    return place;
  }

  Place draw_outlier(Stream& random) const {
    const Vec3 u{random.uniform(), random.uniform(), random.uniform()};
    const auto spread = [](double size, double x) { return kBoxGrowth * size * (x - 0.5); };
    const Vec3 offset{spread(size_.x, u.x), spread(size_.y, u.y), spread(size_.z, u.z)};
    const Vec3 normal = random.direction();
    // It lies nowhere on the surface: its attributes are of any place there.
    Place place = draw_uniform(random);
    place.point = low_ + 0.5 * size_ + offset;
    place.normal = normal;
    return place;
  }

 private:
  const Mesh& mesh_;
  Bounds bounds_;
  UnitFrame frame_;
  Vec3 low_, size_;
  Vec3 falloff_;
  std::vector<double> sums_;  // twice the area of all triangles up to and with each
};

// `normal` turned about a random axis perpendicular to it.
Vec3 turned(const Vec3& normal, double deviation_degrees, Stream& random) {
  const double angle = deviation_degrees * pi / 180 * random.gaussian_pair().first;
  const double phi = 2 * pi * random.uniform();
  // The coordinate axis farthest from the normal makes a well-conditioned frame.
  const Vec3 other = std::abs(normal.x) <= 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 a = normalized(cross(normal, other)), b = cross(normal, a);
  return std::cos(angle) * normal + std::sin(angle) * (std::cos(phi) * a + std::sin(phi) * b);
}

// Point k of the sample; every floor(share n)-th is an outlier.
Place make_point(const Surface& surface, const SampleOptions& o, std::size_t k) {
  Stream random(o.seed, k);
  const double before = std::floor(o.outliers * static_cast<double>(k));
  if (std::floor(o.outliers * static_cast<double>(k + 1)) > before) {
    return surface.draw_outlier(random);
  }
  Place place = surface.draw(random);
  if (o.noise > 0) place.point += o.noise * surface.diagonal() * random.gaussian();
  if (o.normal_noise > 0) place.normal = turned(place.normal, o.normal_noise, random);
  return place;
}

void require(bool good, const std::string& what, double value, const std::string& limits) {
  if (good) return;
  throw Error(ErrorCode::kInvalidInput,
              what + " is " + std::to_string(value) + "; it must be " + limits);
}

void check(const SampleOptions& o) {
  const auto within = [](double x, double low, double high) { return x >= low && x <= high; };
  require(o.points >= 1 && o.points <= kMaxPoints, "the number of points",
          static_cast<double>(o.points), "1 ... " + std::to_string(kMaxPoints));
  require(within(o.noise, 0, 1), "the noise", o.noise, "0 ... 1 of the diagonal");
  require(within(o.normal_noise, 0, 180), "the noise of normals", o.normal_noise,
          "0 ... 180 degrees");
  require(within(o.outliers, 0, 1), "the share of outliers", o.outliers, "0 ... 1");
  require(o.holes >= 0 && o.holes <= 1000, "the number of holes", o.holes, "0 ... 1000");
  require(within(o.hole_radius, 0, 1), "the radius of holes", o.hole_radius,
          "0 ... 1 of the diagonal");
  require(within(o.density_ratio, 1, kMaxDensityRatio), "the density ratio", o.density_ratio,
          "1 ... " + std::to_string(static_cast<int>(kMaxDensityRatio)));
}

// Those of a mesh that a sample has, too: normals it has of its own.
std::vector<const Attribute*> attributes_to_sample(const Mesh& mesh) {
  std::vector<const Attribute*> attributes;
  for (const Attribute& a : mesh.attributes) {
    if (a.name != "nx" && a.name != "ny" && a.name != "nz") attributes.push_back(&a);
  }
  return attributes;
}

// The value at a place between three corners, of the attribute's type. Where a corner has no number
// the others count alone.
double value_at(const Attribute& attribute, const Triangle& t, const Place& place) {
  double value = 0, sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double own = attribute.values[t[k]];
    if (!std::isfinite(own)) continue;
    value += place.weights[k] * own;
    sum += place.weights[k];
  }
  value /= sum;
  if (attribute.type == ScalarType::kFloat64) return value;
  if (attribute.type == ScalarType::kFloat32) return static_cast<double>(static_cast<float>(value));
  return std::round(value);
}

// Leaves the points that are marked, and says how many.
std::size_t keep(const std::vector<char>& marked, PointCloud& cloud) {
  const auto squeeze = [&](auto& values) {
    std::size_t n = 0;
    CancelPoll poll;
    for (std::size_t k = 0; k < values.size(); ++k) {
      poll();
      if (marked[k]) values[n++] = values[k];
    }
    values.resize(n);
  };
  squeeze(cloud.points);
  squeeze(cloud.normals);
  for (Attribute& a : cloud.attributes) squeeze(a.values);
  return cloud.points.size();
}

std::vector<Vec3> hole_centers(const Surface& surface, const SampleOptions& o) {
  Stream random(o.seed, kHoleStream);
  std::vector<Vec3> centers;
  centers.reserve(static_cast<std::size_t>(o.holes));
  for (int i = 0; i < o.holes; ++i) centers.push_back(surface.draw_uniform(random).point);
  return centers;
}

}  // namespace

PointCloud sample_surface(const Mesh& mesh, const SampleOptions& options, const Context& context) {
  validate(mesh);
  check(options);
  const Surface surface(mesh, options.density_ratio);
  if (!surface.has_area()) {
    throw Error(ErrorCode::kInvalidInput,
                "a surface of area 0 (" + std::to_string(mesh.triangles.size()) +
                    " triangles) cannot be sampled; give a mesh with a triangle of positive area");
  }
  const std::vector<Vec3> holes = hole_centers(surface, options);
  const double hole_radius = options.hole_radius * surface.diagonal();
  PointCloud cloud;
  cloud.points.resize(options.points);
  if (options.normals) cloud.normals.resize(options.points);
  const std::vector<const Attribute*> given = attributes_to_sample(mesh);
  for (const Attribute* a : given) {
    cloud.attributes.push_back({a->name, a->type, std::vector<double>(options.points)});
  }
  std::vector<char> kept(options.points, 1);
  parallel_for(options.points, kGrain, context, {.name = "sample"},
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t k = begin; k < end; ++k) {
                   const Place place = make_point(surface, options, k);
                   for (const Vec3& center : holes) {
                     if (norm(place.point - center) <= hole_radius) kept[k] = 0;
                   }
                   cloud.points[k] = surface.frame().to_shape(place.point);
                   if (options.normals) cloud.normals[k] = place.normal;
                   const Triangle& t = mesh.triangles[place.triangle];
                   for (std::size_t a = 0; a < given.size(); ++a) {
                     cloud.attributes[a].values[k] = value_at(*given[a], t, place);
                   }
                 }
               });
  const std::size_t n = keep(kept, cloud);
  if (n == 0) {
    throw Error(ErrorCode::kInvalidInput,
                "the " + std::to_string(options.holes) + " holes of radius " +
                    std::to_string(options.hole_radius) + " of the diagonal leave none of the " +
                    std::to_string(options.points) + " points; take fewer or smaller ones");
  }
  return cloud;
}

}  // namespace rholm
