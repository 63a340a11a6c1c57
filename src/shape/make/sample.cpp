// Random points on a surface. Every point has a stream of random numbers of its own, so that the
// points do not depend on threads, nor on how many numbers another one took.
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
#include "rholm/error.h"
#include "rholm/points.h"
#include "shape/make/sample_pattern.h"
#include "shape/make/sample_scans.h"
#include "shape/make/surface_places.h"
#include "shape/points/plane_fit.h"

namespace rholm {
namespace {

using std::numbers::pi;

constexpr std::size_t kGrain = 4096;                      // points per chunk; chosen: some 0.5 ms
constexpr std::uint64_t kHoleStream = ~std::uint64_t{0};  // no point has this number

// `normal` turned about a random axis perpendicular to it.
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

// Where points come from: the surface at random, a pattern, or scanners.
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

  // Every floor(share n)-th is an outlier. Nothing where a scanner finds no place, or the law of
  // density leaves none of a pattern.
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

// Those of a mesh that a sample has, too: normals and scanners it has of its own.
std::vector<const Attribute*> attributes_to_sample(const Mesh& mesh) {
  std::vector<const Attribute*> attributes;
  for (const Attribute& a : mesh.attributes) {
    constexpr std::array kOwn = {"nx", "ny", "nz", "scan", "sensor_x", "sensor_y", "sensor_z"};
    if (std::find(kOwn.begin(), kOwn.end(), a.name) == kOwn.end()) attributes.push_back(&a);
  }
  return attributes;
}

// The value at a place between three corners, of the attribute's type. Where a corner has no number
// the others count alone.
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

// Those that tell of the scanners.
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
                "a surface of area 0 (" + std::to_string(mesh.triangles.size()) +
                    " triangles) cannot be sampled; give a mesh with a triangle of positive area");
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
      const Triangle& t = mesh.triangles[place.triangle];
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
