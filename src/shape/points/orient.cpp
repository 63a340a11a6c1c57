// Normals of points: directions, signs, and what is known of both (method 7.12).
#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/refuse.h"
#include "rholm/points.h"
#include "shape/points/normals.h"
#include "shape/points/orient_graph.h"
#include "shape/points/orient_scene.h"
#include "shape/points/orient_signs.h"
#include "shape/points/sensors.h"

namespace rholm {
namespace {

// Cosine of the angle between a normal and the line of sight below which the sign is that of
// others: normals of exact points are off by less than these six degrees, of noisy ones most are.
constexpr float kGlancing = 0.1f;

void check(const PointCloud& cloud, const OrientOptions& options) {
  validate(cloud);
  if (cloud.points.size() > kMaxPoints) {
    refuse("there are " + std::to_string(cloud.points.size()) + " points, at most " +
           std::to_string(kMaxPoints) + " can be oriented; thin them out first");
  }
  if (options.neighbors != 0 && (options.neighbors < 3 || options.neighbors > 1000)) {
    refuse("the number of neighbours is " + std::to_string(options.neighbors) +
           "; it must be 3 ... 1000, or 0 to have it chosen");
  }
  if (options.center && options.sensor) {
    refuse("a centre and a sensor exclude each other; give one of them");
  }
  for (const std::optional<Vec3>& place : {options.center, options.sensor}) {
    if (place && !is_finite(*place)) refuse("the centre or sensor is not a finite point");
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

// Where each point of the scene has been seen from; empty if nothing is known of it.
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

// Signs by the line of sight.
OrientSigns turn_by_sight(const OrientScene& scene, const LocalFits& fits,
                          std::span<const Vec3> sensors, bool from_inside) {
  OrientSigns signs{.normals = fits.normals};
  const std::size_t n = signs.normals.size();
  signs.agreement.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 away = normalized(scene.points[i] - sensors[i]);
    const double cosine = dot(signs.normals[i], from_inside ? away : -away);
    if (cosine < 0) signs.normals[i] = -signs.normals[i];
    signs.agreement[i] = static_cast<float>(std::abs(cosine));
  }
  return signs;
}

// What is seen at a glancing angle agrees with what is seen better around it.
void turn_glancing(const OrientScene& scene, const LocalFits& fits, OrientSigns& signs) {
  const std::vector<Vec3> seen = signs.normals;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!(signs.agreement[i] < kGlancing)) continue;
    double sum = 0;
    for (std::size_t k = 0; k < kGraphNeighbors; ++k) {
      const std::uint32_t j = fits.neighbors[i * kGraphNeighbors + k];
      if (signs.agreement[j] < kGlancing) continue;
      sum += agreement(scene.points[i], seen[i], scene.points[j], seen[j], 0);
    }
    if (sum < 0) signs.normals[i] = -seen[i];
  }
}

// The sign is right with the probability 1 / 2 + confidence / 2, or a larger one. Of 2.4 million
// points of sixty inputs (scripts/scan-figures) with an agreement of 0.15, 0.25, 0.35, 0.45, 0.55,
// 0.65 are wrong 0.034, 0.032, 0.009, 0.003, 0.001, 0.0008; this says 0.11, 0.04, 0.015, 0.006,
// 0.002, 0.0008.
double confidence_of(double agreement) { return 1 - std::exp(-10 * agreement); }

// Writes the normals to the points of the input and counts what has become of them.
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
    report.strays += scene.stray[i];
    confidence[i] = scene.stray[i] != 0 ? 0.0 : confidence_of(signs.agreement[place]);
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
  const OrientScene scene = make_orient_scene(cloud, !by_sight && !options.keep_strays, context);
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
                          : turn_by_sight(scene, fits, sensors, options.center.has_value());
  if (!sensors.empty() && !by_sight) turn_glancing(scene, fits, signs);
  report.neighbors = fits.n_neighbors;
  hand_back(scene, signs, options, cloud, report);
  return report;
}

}  // namespace rholm
