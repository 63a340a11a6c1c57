// Makes random points on a surface. Every point has its own stream of random numbers. So it depends
// neither on threads nor on how many numbers other points use.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "base/check_fields.h"
#include "base/parallel.h"
#include "base/resize_asking.h"
#include "rholm/context.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "shape/make/sample_pattern.h"
#include "shape/make/surface_places.h"
#include "shape/points/plane_fit.h"
#include "shape/queries/ray_scene.h"
#include "shape/rigid_motion.h"

namespace rholm {
namespace {

// A scanner that looks at a surface from outside.
struct Scanner {
  Vec3 at;             // in the frame of the surface
  RigidMotion motion;  // about the surface's middle: error of the scan's pose
  double noise = 0;    // of its points, relative to the diagonal
};

// Scanners around a surface. Keeps references to the surface and the options.
class Scans {
 public:
  Scans(const SampledSurface& surface, const SampleOptions& options);

  const std::vector<Scanner>& scanners() const { return scanners_; }
  // Returns a random visible point, by the density of rays; nothing if no visible point is found.
  std::optional<SurfacePlace> draw(std::size_t scan, RandomStream& random) const;
  // Returns hits of rays in lines, about options.points / options.scans of them.
  std::vector<SurfacePlace> lines(std::size_t scan, const Context& context) const;

 private:
  bool sees(const Scanner& scanner, const SurfacePlace& place) const;

  const SampledSurface& surface_;
  const SampleOptions& options_;
  double radius_ = 0;  // of a ball around the middle that contains the surface
  Mesh local_;
  std::optional<RayScene> scene_;
  std::vector<Scanner> scanners_;
};

using std::numbers::pi;

// Chosen: like a scanner on a tripod, which sees most of one side.
constexpr double kDistance = 3;  // relative to the radius

constexpr std::uint64_t kScannerStream = std::uint64_t{1} << 63;
constexpr int kMostTries = 1000;  // to find a visible place

// Relative to the distance: a ray that ends so near before a place has met the place's surface.
constexpr double kNear = 1e-5;

// Least share of the field: a smaller surface gets fewer points instead of more rays.
constexpr double kLeastSeen = 0.005;

constexpr std::size_t kProbes = 64;  // rays per side that measure the visible share of the field

// Returns directions spread evenly over the sphere, along a spiral.
Vec3 on_spiral(std::size_t i, std::size_t n) {
  const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
  const double phi = static_cast<double>(i) * pi * (3 - std::sqrt(5.0));
  const double s = std::sqrt(1 - z * z);
  return {s * std::cos(phi), s * std::sin(phi), z};
}

double mean_square_distance(const SampledSurface& surface) {
  double sum = 0;
  for (std::size_t t = 0; t < surface.mesh().faces.size(); ++t) {
    const auto [a, b, c] = surface.corners(t);
    const Vec3 from = (a + b + c) / 3 - surface.middle();
    sum += norm(surface.twice_area(t)) / 2 * dot(from, from);
  }
  return sum / surface.area();
}

Scans::Scans(const SampledSurface& surface, const SampleOptions& options)
    : surface_(surface), options_(options) {
  for (const Vec3& vertex : surface.mesh().vertices) {
    local_.vertices.push_back(surface.frame().to_local(vertex));
    radius_ = std::max(radius_, norm(local_.vertices.back() - surface.middle()));
  }
  local_.faces = surface.mesh().faces;
  scene_.emplace(local_);
  // Shifts contribute half of the mean square, 3 s^2, and turns the other half, 2 s^2 |x|^2.
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
    // The number of rays that meet an area is proportional to this cosine.
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

using std::numbers::pi;

constexpr std::size_t kGrain = 4096;                      // points per chunk; chosen: some 0.5 ms
constexpr std::uint64_t kHoleStream = ~std::uint64_t{0};  // no point has this number

// Returns `normal` turned about a random axis perpendicular to it.
Vec3 turned(const Vec3& normal, double deviation_degrees, RandomStream& random) {
  const double angle = deviation_degrees * pi / 180 * random.gaussian_pair().first;
  const double phi = 2 * pi * random.uniform();
  const Vec3 a = perpendicular(normal), b = cross(normal, a);
  return std::cos(angle) * normal + std::sin(angle) * (std::cos(phi) * a + std::sin(phi) * b);
}

struct SampledPoint {
  SurfacePlace place;
  std::size_t scan = 0;
};

// Source of the points: random places on the surface, a pattern, or scanners.
class Source {
 public:
  Source(const SampledSurface& surface, const SampleOptions& options, const Context& context)
      : surface_(surface), o_(options) {
    if (o_.scans > 0) scans_.emplace(surface, options);
    if (o_.pattern == SamplePattern::kLines) {
      for (std::size_t scan = 0; scan < scans_->scanners().size(); ++scan) {
        for (SurfacePlace& place : scans_->lines(scan, context)) fixed_.push_back({place, scan});
      }
    } else if (o_.pattern != SamplePattern::kRandom) {
      for (SurfacePlace& place : pattern_places(surface, options, context)) {
        fixed_.push_back({place, 0});
      }
    }
    size_ = o_.pattern == SamplePattern::kRandom ? o_.points : fixed_.size();
  }

  std::size_t size() const { return size_; }
  const Scanner& scanner(std::size_t scan) const { return scans_->scanners()[scan]; }

  // Returns point k; about every (1 / outliers)-th is an outlier. Returns nothing if a scanner sees
  // no place, or the law of density removes a place of a pattern.
  std::optional<SampledPoint> point(std::size_t k) const {
    RandomStream random(o_.seed, k);
    SampledPoint point;
    if (!fixed_.empty()) {
      point = fixed_[k];
    } else if (scans_) {
      point.scan = k * static_cast<std::size_t>(o_.scans) / size_;
    }
    const double before = std::floor(o_.outliers * static_cast<double>(k));
    if (std::floor(o_.outliers * static_cast<double>(k + 1)) > before) {
      point.place = surface_.draw_outlier(random);
      return point;
    }
    if (!fixed_.empty()) {
      if (o_.density_ratio > 1 && !surface_.keeps(point.place, random)) return {};
    } else if (scans_) {
      const std::optional<SurfacePlace> seen = scans_->draw(point.scan, random);
      if (!seen) return {};
      point.place = *seen;
    } else {
      point.place = surface_.draw(random);
    }
    const double noise = scans_ ? scanner(point.scan).noise : o_.noise;
    SurfacePlace& place = point.place;
    if (noise > 0) place.point += noise * surface_.diagonal() * random.gaussian();
    if (o_.normal_noise > 0) place.normal = turned(place.normal, o_.normal_noise, random);
    if (o_.misalignment > 0) {
      const RigidMotion& motion = scanner(point.scan).motion;
      place.point = motion.point(place.point);
      place.normal = motion.direction(place.normal);
    }
    return point;
  }

 private:
  const SampledSurface& surface_;
  const SampleOptions& o_;
  std::optional<Scans> scans_;
  std::vector<SampledPoint> fixed_;
  std::size_t size_ = 0;
};

void check(const SampleOptions& o) {
  check_fields(o);
  const Vec3& axis = o.pattern_axis;
  if (!is_finite(axis) || !(norm(axis) > 1e-100 && norm(axis) < 1e100)) {
    throw Error(ErrorCode::kInvalidInput, "the axis of the pattern has no direction");
  }
  const bool scanned = o.misalignment > 0 || o.scan_noise > 0 || o.sensor;
  if (o.scans == 0 && (scanned || o.pattern == SamplePattern::kLines)) {
    throw Error(ErrorCode::kInvalidInput,
                "lines, misalignment, noise per scan and sensors are those of scans: say how many");
  }
  if (o.scans > 0 && o.pattern != SamplePattern::kRandom && o.pattern != SamplePattern::kLines) {
    throw Error(ErrorCode::kInvalidInput,
                std::string("scans have lines or random points, no ") + to_string(o.pattern));
  }
}

// Returns the mesh's attributes that a sample takes over. Normals and scanners are its own.
std::vector<const Attribute*> attributes_to_sample(const Mesh& mesh) {
  std::vector<const Attribute*> attributes;
  for (const Attribute& a : mesh.attributes) {
    constexpr std::array kOwn = {"nx", "ny", "nz", "scan", "sensor_x", "sensor_y", "sensor_z"};
    if (std::find(kOwn.begin(), kOwn.end(), a.name) == kOwn.end()) attributes.push_back(&a);
  }
  return attributes;
}

// Returns the value at a place between three corners, in the attribute's type. Corners
// without a number are left out.
double value_at(const Attribute& attribute, const Triangle& t, const SurfacePlace& place) {
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

// Keeps the marked points; returns their number.
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

// Returns the attributes that describe the scanners.
std::vector<std::pair<std::string, ScalarType>> own_attributes(const SampleOptions& o) {
  std::vector<std::pair<std::string, ScalarType>> own;
  if (o.scans > 0) own.emplace_back("scan", ScalarType::kInt32);
  if (o.sensor) {
    for (const char* name : {"sensor_x", "sensor_y", "sensor_z"}) {
      own.emplace_back(name, ScalarType::kFloat64);
    }
  }
  return own;
}

std::vector<Vec3> hole_centers(const SampledSurface& surface, const SampleOptions& o) {
  RandomStream random(o.seed, kHoleStream);
  std::vector<Vec3> centers;
  centers.reserve(static_cast<std::size_t>(o.holes));
  for (int i = 0; i < o.holes; ++i) centers.push_back(surface.draw_uniform(random).point);
  return centers;
}

}  // namespace

PointCloud sample_surface(const Mesh& mesh, const SampleOptions& options, const Context& context) {
  validate(mesh);
  check(options);
  const SampledSurface surface(mesh, options.density_ratio);
  if (!surface.has_area()) {
    throw Error(ErrorCode::kInvalidInput,
                "a surface of area 0 (" + std::to_string(mesh.faces.size()) +
                    " faces) cannot be sampled; give a mesh with a face of positive area");
  }
  const std::vector<Vec3> holes = hole_centers(surface, options);
  const double hole_radius = options.hole_radius * surface.diagonal();
  const Source source(surface, options, context);
  const std::size_t n = source.size();
  PointCloud cloud;
  resize_asking(cloud.points, n);
  if (options.normals) resize_asking(cloud.normals, n);
  const std::vector<const Attribute*> given = attributes_to_sample(mesh);
  for (const Attribute* a : given) {
    resize_asking(cloud.attributes.emplace_back(Attribute{a->name, a->type, {}}).values, n);
  }
  const std::size_t first_own = cloud.attributes.size();
  for (const auto& [name, type] : own_attributes(options)) {
    resize_asking(cloud.attributes.emplace_back(Attribute{name, type, {}}).values, n);
  }
  std::vector<char> kept(n, 1);
  parallel_for(n, kGrain, context, {.name = "sample"}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::optional<SampledPoint> point = source.point(k);
      kept[k] = point.has_value();
      if (!point) continue;
      const SurfacePlace& place = point->place;
      for (const Vec3& center : holes) {
        if (norm(place.point - center) <= hole_radius) kept[k] = 0;
      }
      cloud.points[k] = surface.frame().to_shape(place.point);
      if (options.normals) cloud.normals[k] = place.normal;
      const Triangle& t = mesh.faces[place.triangle];
      for (std::size_t a = 0; a < given.size(); ++a) {
        cloud.attributes[a].values[k] = value_at(*given[a], t, place);
      }
      if (options.scans > 0) {
        cloud.attributes[first_own].values[k] = static_cast<double>(point->scan);
      }
      if (options.sensor) {
        const Scanner& scanner = source.scanner(point->scan);
        const Vec3 at = surface.frame().to_shape(scanner.motion.point(scanner.at));
        cloud.attributes[first_own + 1].values[k] = at.x;
        cloud.attributes[first_own + 2].values[k] = at.y;
        cloud.attributes[first_own + 3].values[k] = at.z;
      }
    }
  });
  if (keep(kept, cloud) == 0) {
    throw Error(ErrorCode::kInvalidInput,
                "holes (" + std::to_string(options.holes) + " of radius " +
                    std::to_string(options.hole_radius) +
                    " of the diagonal), the pattern or the scanners leave none of the " +
                    std::to_string(options.points) + " points; take fewer or smaller holes");
  }
  return cloud;
}

EnumNames names_of(SamplePattern) {
  static constexpr const char* kNames[] = {"random", "slices", "rings", "lines", "grid"};
  return {"pattern", kNames};
}

}  // namespace rholm
