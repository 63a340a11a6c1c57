// Computes normals of points: directions, signs and their confidence (method 7.12).
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/check_fields.h"
#include "base/refuse.h"
#include "rholm/points.h"
#include "shape/points/normals.h"
#include "shape/points/orient_scene.h"
#include "shape/points/orient_sight.h"
#include "shape/points/orient_signs.h"
#include "shape/points/sensors.h"

namespace rholm {
namespace {

void check(const PointCloud& cloud, const OrientOptions& options) {
  validate(cloud);
  if (cloud.points.size() > kMaxPoints) {
    refuse("there are " + std::to_string(cloud.points.size()) + " points, at most " +
           std::to_string(kMaxPoints) + " can be oriented; thin them out first");
  }
  check_fields(options);
  if (options.center && options.sensor) {
    refuse("a centre and a sensor exclude each other; give one of them");
  }
}

std::vector<Vec3> given_directions(const PointCloud& cloud, const OrientScene& scene) {
  std::vector<Vec3> given(scene.place.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Vec3 n = cloud.normals[scene.place[i]];
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (largest > 0) given[i] = normalized({n.x / largest, n.y / largest, n.z / largest});
  }
  return given;
}

// Returns the sensor of each point of the scene; empty if no sensors are known.
std::vector<Vec3> sensors_of(const PointCloud& cloud, const OrientScene& scene,
                             const OrientOptions& options) {
  const std::size_t n = scene.points.size();
  if (options.center || options.sensor) {
    return std::vector<Vec3>(
        n, scene.frame.to_local(options.center ? *options.center : *options.sensor));
  }
  const std::vector<Vec3> given = sensors_of(cloud);
  if (given.empty()) return {};
  std::vector<Vec3> sensors(n);
  for (std::size_t i = 0; i < n; ++i) sensors[i] = scene.frame.to_local(given[scene.place[i]]);
  return sensors;
}

// Writes the normals to the points of the input, and counts changes in the report.
void hand_back(const OrientScene& scene, const OrientSigns& signs, const OrientOptions& options,
               PointCloud& cloud, OrientReport& report) {
  const std::vector<Vec3> old = std::move(cloud.normals);
  const std::size_t n = cloud.points.size();
  cloud.normals.resize(n);
  std::vector<double> confidence(n);
  std::size_t unsure = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t place = scene.taken[i];
    const Vec3& normal = signs.normals[place];
    cloud.normals[i] = normal;
    const bool had = !old.empty() && !(old[i] == Vec3{});
    report.computed += !had || !options.keep_directions;
    report.flipped += had && dot(old[i], normal) < 0;
    report.undetermined += normal == Vec3{};
    report.outliers += scene.isolated[i];
    confidence[i] = scene.isolated[i] != 0 ? 0.0 : confidence_of(signs.agreement[place]);
    report.mean_confidence += confidence[i] / static_cast<double>(n);
    unsure += confidence[i] < 0.5;
  }
  report.unsure = static_cast<double>(unsure) / static_cast<double>(n);
  report.duplicates = scene.duplicates;
  if (options.confidence) {
    set_attribute(cloud.attributes, {"confidence", ScalarType::kFloat32, std::move(confidence)});
  }
}

}  // namespace

OrientReport orient(PointCloud& cloud, const OrientOptions& options, const Context& context) {
  check(cloud, options);
  OrientReport report{.points = cloud.points.size()};
  const bool by_sight = options.center || options.sensor;
  const OrientScene scene = make_orient_scene(cloud, !by_sight && !options.keep_outliers, context);
  std::vector<Vec3> given;
  if (options.keep_directions && !cloud.normals.empty()) given = given_directions(cloud, scene);
  LocalFits fits =
      fit_normals(*scene.tree, scene.points, scene.gaps, given, options.neighbors, context);
  if (std::all_of(fits.normals.begin(), fits.normals.end(),
                  [](const Vec3& n) { return n == Vec3{}; })) {
    refuse_line(cloud.points.size());
  }
  const std::vector<Vec3> sensors = sensors_of(cloud, scene, options);
  OrientSigns signs = sensors.empty()
                          ? find_signs(scene, given, fits, report, context)
                          : turn_by_sight(scene.points, fits, sensors, options.center.has_value());
  if (!sensors.empty() && !by_sight) turn_glancing(scene.points, fits, signs);
  report.neighbors = fits.n_neighbors;
  hand_back(scene, signs, options, cloud, report);
  return report;
}

}  // namespace rholm
