// Normals of points: directions, signs, and what is known of both (method 9).
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/parallel.h"
#include "base/refuse.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "shape/face.h"
#include "shape/on_line.h"
#include "shape/points/normals.h"
#include "shape/points/orient_graph.h"
#include "shape/points/orient_sides.h"
#include "shape/topology/identical.h"

namespace rholm {
namespace {

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

[[noreturn]] void refuse_line(std::size_t n) {
  refuse("all " + std::to_string(n) +
         " points lie on one line, where there are no normals; give points of a surface");
}

// Of the extent: fits see points in single precision, ten roundings of which are no width.
constexpr double kLine = 1e-6;

// The distinct points in the order of a tree over them, moved and scaled to the size of 1.
struct Scene {
  UnitFrame frame;
  std::vector<std::uint32_t> first;       // per input point: the one it coincides with
  std::vector<std::uint32_t> place = {};  // per distinct point of the scene: its input point
  std::vector<Vec3> points = {};
  std::optional<PointTree> tree = {};
};

Scene make_scene(const PointCloud& cloud, const Context& context) {
  Scene scene{.frame = unit_frame(bounds(cloud.points)), .first = first_identical(cloud.points)};
  std::vector<std::uint32_t> distinct;
  std::vector<Vec3> local;
  for (std::uint32_t i = 0; i < scene.first.size(); ++i) {
    if (scene.first[i] != i) continue;
    distinct.push_back(i);
    local.push_back(scene.frame.to_local(cloud.points[i]));
  }
  if (distinct.size() < 3) {
    throw Error(ErrorCode::kInvalidInput,
                std::to_string(cloud.points.size()) + " points at " +
                    std::to_string(distinct.size()) +
                    " different places have no plane; at least 3 places are needed");
  }
  // Told from the points at once; fits of millions of them would take a minute to find no plane.
  if (lie_on_line(local, kLine)) refuse_line(cloud.points.size());
  scene.tree.emplace(local, context);
  scene.place.resize(distinct.size());
  scene.points.resize(distinct.size());
  for (std::size_t i = 0; i < distinct.size(); ++i) {
    scene.place[i] = distinct[scene.tree->order()[i]];
    scene.points[i] = local[scene.tree->order()[i]];
  }
  return scene;
}

std::vector<Vec3> given_directions(const PointCloud& cloud, const Scene& scene) {
  std::vector<Vec3> given(scene.place.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Vec3 n = cloud.normals[scene.place[i]];
    const double largest = std::max({std::abs(n.x), std::abs(n.y), std::abs(n.z)});
    if (largest > 0) given[i] = normalized({n.x / largest, n.y / largest, n.z / largest});
  }
  return given;
}

// Signs by the line of sight; returns the confidence per point.
std::vector<float> turn_by_sight(const Scene& scene, const OrientOptions& options,
                                 std::vector<Vec3>& normals) {
  const Vec3 from = scene.frame.to_local(options.center ? *options.center : *options.sensor);
  std::vector<float> confidence(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const Vec3 away = normalized(scene.points[i] - from);
    const double cosine = dot(normals[i], options.center ? away : -away);
    if (cosine < 0) normals[i] = -normals[i];
    confidence[i] = static_cast<float>(std::abs(cosine));
  }
  return confidence;
}

// Signs by the neighbours and the winding number; returns the confidence per point.
std::vector<float> turn_by_graph(const Scene& scene, const LocalFits& fits,
                                 std::vector<Vec3>& normals, OrientReport& report,
                                 const Context& context) {
  const OrientedParts parts = orient_along_graph(scene.points, fits, normals);
  report_progress(context, "signs", 0.5);
  // So many points share the disc of a fit.
  std::vector<double> areas(normals.size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const double radius = fits.radius[i];
    areas[i] = std::numbers::pi * radius * radius / (fits.n_neighbors + 0.5);
  }
  const std::vector<double> trust = turn_outwards(scene.points, areas, parts, normals, context);
  report.components = parts.n_components;
  std::vector<float> confidence = mean_agreement(scene.points, fits, normals);
  for (std::size_t i = 0; i < confidence.size(); ++i) {
    confidence[i] *= static_cast<float>(trust[parts.component[i]]);
  }
  return confidence;
}

// Writes the normals to the points of the input and counts what has become of them.
void hand_back(const Scene& scene, const std::vector<Vec3>& normals,
               const std::vector<float>& confidence, const OrientOptions& options,
               PointCloud& cloud, OrientReport& report) {
  const std::vector<Vec3> old = std::move(cloud.normals);
  std::vector<std::uint32_t> in_scene(cloud.points.size());
  for (std::uint32_t i = 0; i < scene.place.size(); ++i) in_scene[scene.place[i]] = i;
  cloud.normals.resize(cloud.points.size());
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const std::uint32_t place = in_scene[scene.first[i]];
    const Vec3& normal = normals[place];
    cloud.normals[i] = normal;
    report.duplicates += scene.first[i] != i;
    const bool had = !old.empty() && !(old[i] == Vec3{});
    report.computed += !had || !options.keep_directions;
    report.flipped += had && dot(old[i], normal) < 0;
    report.undetermined += normal == Vec3{};
    report.mean_confidence += confidence[place];
    report.unsure += confidence[place] < 0.5f;
  }
  report.mean_confidence /= static_cast<double>(cloud.points.size());
  report.unsure /= static_cast<double>(cloud.points.size());
}

}  // namespace

OrientReport orient(PointCloud& cloud, const OrientOptions& options, const Context& context) {
  check(cloud, options);
  OrientReport report{.points = cloud.points.size()};
  const Scene scene = make_scene(cloud, context);
  std::vector<Vec3> given;
  if (options.keep_directions && !cloud.normals.empty()) given = given_directions(cloud, scene);
  LocalFits fits = fit_normals(*scene.tree, scene.points, given, options.neighbors, context);
  report.neighbors = fits.n_neighbors;
  if (std::all_of(fits.normals.begin(), fits.normals.end(),
                  [](const Vec3& n) { return n == Vec3{}; })) {
    refuse_line(cloud.points.size());
  }
  std::vector<Vec3> normals = std::move(fits.normals);
  const std::vector<float> confidence = options.center || options.sensor
                                            ? turn_by_sight(scene, options, normals)
                                            : turn_by_graph(scene, fits, normals, report, context);
  hand_back(scene, normals, confidence, options, cloud, report);
  return report;
}

}  // namespace rholm
