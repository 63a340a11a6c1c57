#include "model/points/reconstruct_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/large_vector.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/topology.h"
#include "shape/on_line.h"
#include "shape/points/outliers.h"
#include "shape/points/sensors.h"
#include "shape/points/side_balance.h"
#include "shape/points/strays.h"

namespace rholm {
namespace {

constexpr std::size_t kFewestPoints = 16;  // as many as a cap has coefficients
constexpr std::size_t kSpacingSeeds = 2000;
// Of one place: the radius of 24 random points scatters by a tenth, that of 8 by a fifth.
constexpr std::size_t kCircles = 3;
// Of even random points the tenth lies at 0.8 of the median; a finer part of uneven ones below.
constexpr double kTenthOfEven = 0.8;
// Of the diagonal: points no farther from one line than this have no surface, whatever their
// normals; far above what single precision does to a line.
constexpr double kLine = 1e-5;
// Length of the mean normal from which nothing is enclosed: of a cap of a sphere of 37 degrees.
constexpr double kFlat = 0.9;
// Diagonals: squares of distances between neighbours must stay within single precision.
constexpr double kSmallest = 1e-12, kLargest = 1e12;
// Each sees what the one before has left (method 7.4).
constexpr int kOutlierPasses = 3;
// Of the points; smaller groups, where there are outliers, are made of them.
constexpr double kLeastGroup = 0.002;

// keep(i): whether point i stays.
template <typename Keep>
void keep_points(PointCloud& cloud, const Keep& keep) {
  std::size_t kept = 0;
  const std::size_t n = cloud.points.size();
  const bool directed = !cloud.normals.empty();
  for (std::size_t i = 0; i < n; ++i) {
    if (!keep(i)) continue;
    cloud.points[kept] = cloud.points[i];
    if (directed) cloud.normals[kept] = cloud.normals[i];
    for (Attribute& attribute : cloud.attributes) attribute.values[kept] = attribute.values[i];
    ++kept;
  }
  cloud.points.resize(kept);
  if (directed) cloud.normals.resize(kept);
  for (Attribute& attribute : cloud.attributes) attribute.values.resize(kept);
}

// Whether there is one normal, or none, and one of every attribute to a point.
bool lists_fit(const PointCloud& cloud) {
  const std::size_t n = cloud.points.size();
  return (cloud.normals.empty() || cloud.normals.size() == n) &&
         std::all_of(cloud.attributes.begin(), cloud.attributes.end(),
                     [n](const Attribute& attribute) { return attribute.values.size() == n; });
}

// Points without a direction are of no use here.
void drop_zero_normals(PointCloud& cloud) {
  keep_points(cloud, [&](std::size_t i) { return norm(cloud.normals[i]) > 0; });
}

void check_spread(const PointCloud& cloud, double diagonal) {
  if (cloud.points.size() < kFewestPoints) {
    throw Error(
        ErrorCode::kInvalidInput,
        fmt::format("{} different {} too few for a surface: {} at least", cloud.points.size(),
                    cloud.points.size() == 1 ? "point with a normal is" : "points with normals are",
                    kFewestPoints));
  }
  if (!(diagonal > kSmallest && diagonal < kLargest)) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("the points span {}: {} ... {} can be worked with; take another unit",
                            diagonal, kSmallest, kLargest));
  }
}

void check_width(const std::vector<Vec3>& points, double diagonal) {
  if (!lie_on_line(points, kLine * diagonal)) return;
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("all {} points lie on one line, within {:.0e} of its length: give "
                          "points of a surface",
                          points.size(), kLine));
}

[[noreturn]] void refuse_flat(std::size_t n) {
  throw Error(ErrorCode::kInvalidInput,
              fmt::format("these {} points bound no solid: their normals all point to one side, as "
                          "of a plane; '--holes keep' (HolePolicy::kKeep) makes an open sheet",
                          n));
}

}  // namespace

WorkingPoints::WorkingPoints(PointCloud cloud, const ReconstructOptions& options,
                             ReconstructReport& report, const Context& context)
    : cloud_(std::move(cloud)) {
  report.points = cloud_.points.size();
  if (options.remove_outliers && lists_fit(cloud_)) {
    const std::vector<std::uint8_t> far = find_far_strays(cloud_.points);
    report.outliers = static_cast<std::size_t>(std::count(far.begin(), far.end(), 1));
    if (report.outliers > 0) keep_points(cloud_, [&](std::size_t i) { return far[i] == 0; });
  }
  clean(cloud_, context);
  if (options.sensor) put_sensor(*options.sensor);
  const bool directed = std::any_of(cloud_.normals.begin(), cloud_.normals.end(),
                                    [](const Vec3& n) { return norm(n) > 0; });
  if (directed) drop_zero_normals(cloud_);
  if (!directed) cloud_.normals.clear();
  if (options.align_scans) report.scans = align_scans(cloud_, context);
  check_points();
  order_points(context);
  if (options.remove_outliers) report.outliers += remove_strays(context);
  if (options.confidence) {
    // Of normals that are given nothing is known; orient() says what it knows of its own.
    const std::vector<double> sure(cloud_.points.size(), 1.0);
    set_attribute(cloud_.attributes, {"confidence", ScalarType::kFloat32, sure});
  }
  if (!directed) {
    // Strays are gone, if they shall.
    const OrientOptions wanted{.keep_strays = true, .confidence = options.confidence};
    report.unsure = orient(cloud_, wanted, context).unsure;
    report.computed_normals = computed_ = true;
    const std::size_t before = size();
    drop_zero_normals(cloud_);
    if (cloud_.points.size() < before) {
      check_points();
      order_points(context);
    } else {
      order_normals(context);  // they know more of gaps
      gaps_ = find_gaps(*tree_, points_, normals_, context);
    }
  }
  report.dropped_points = report.points - report.outliers - cloud_.points.size();
  const SideBalance balance = balance_sides(*tree_, points_, normals_, context);
  if (options.holes == HolePolicy::kFill && balance.one_sided > kFlat) refuse_flat(size());
  report.turned_normals = directed && balance.inwards;
  if (report.turned_normals) {
    for (Vec3& normal : cloud_.normals) normal = -normal;
    for (Vec3& normal : normals_) normal = -normal;
  }
}

void WorkingPoints::check_points() {
  diagonal_ = bounds(cloud_.points).diagonal();
  check_spread(cloud_, diagonal_);
  check_width(cloud_.points, diagonal_);
}

void WorkingPoints::put_sensor(const Vec3& sensor) {
  const double at[3] = {sensor.x, sensor.y, sensor.z};
  for (std::size_t k = 0; k < 3; ++k) {
    set_attribute(cloud_.attributes, {kSensorAxes[k], ScalarType::kFloat64,
                                      std::vector<double>(cloud_.points.size(), at[k])});
  }
  has_one_sensor_ = true;
}

void WorkingPoints::order_points(const Context& context) {
  tree_ = std::make_unique<PointTree>(cloud_.points, context);
  points_.resize(tree_->size());
  parallel_for(points_.size(), 8192, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) points_[i] = cloud_.points[tree_->order()[i]];
  });
  normals_.clear();
  if (!cloud_.normals.empty()) order_normals(context);
  gaps_ = find_gaps(*tree_, points_, normals_, context);
}

void WorkingPoints::order_normals(const Context& context) {
  normals_.resize(tree_->size());
  parallel_for(normals_.size(), 8192, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      normals_[i] = normalized(cloud_.normals[tree_->order()[i]]);
    }
  });
}

std::size_t WorkingPoints::remove_strays(const Context& context) {
  const std::size_t before = size();
  for (int pass = 0; pass < kStrayPasses; ++pass) {
    if (!remove(find_strays(*tree_, points_, gaps_, context), context)) break;
  }
  return before - size();
}

Spacing WorkingPoints::spacing(const Context& context) const {
  const std::size_t n = size(), seeds = std::min(n, kSpacingSeeds);
  std::vector<double> all(seeds), areas(seeds);
  parallel_for(seeds, 256, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t j = begin; j < end; ++j) {
      const std::size_t i = j * n / seeds;
      const std::size_t around = gaps_.scaled(i, kCircle);
      tree_->nearest_to(i, around + 1, near);
      all[j] = spacing_of_circle(near.back().distance2);
      areas[j] = all[j] * all[j] * static_cast<double>(kCircle) / static_cast<double>(around);
    }
  });
  std::sort(all.begin(), all.end());
  const double median = all[seeds / 2];
  const double sum = std::accumulate(areas.begin(), areas.end(), 0.0);
  return {.median = median,
          .fine = std::min(median, all[seeds / 10] / kTenthOfEven),
          .area = static_cast<double>(n) / static_cast<double>(seeds) * sum};
}

double WorkingPoints::spacing_at(const Vec3& place) const {
  std::vector<Neighbor> near;
  tree_->nearest(place, 1, near);
  tree_->nearest(place, kCircles * gaps_.scaled(near.front().index, kCircle), near);
  return spacing_of_circle(near.back().distance2 / kCircles);
}

bool WorkingPoints::remove(const std::vector<std::uint8_t>& gone, const Context& context) {
  const auto n = static_cast<std::size_t>(std::count(gone.begin(), gone.end(), 1));
  if (n == 0 || size() - n < kFewestPoints) return false;
  std::vector<std::uint8_t> given(gone.size());
  for (std::size_t i = 0; i < gone.size(); ++i) given[tree_->order()[i]] = gone[i];
  keep_points(cloud_, [&](std::size_t i) { return given[i] == 0; });
  diagonal_ = bounds(cloud_.points).diagonal();
  order_points(context);
  return true;
}

double WorkingPoints::wrong_normals(const Context& context) const {
  return computed_ ? 0 : share_of_wrong_normals(*tree_, normals_, context);
}

std::size_t WorkingPoints::remove_outliers(double noise, std::size_t most,
                                           std::span<const std::uint32_t> suspects,
                                           const Context& context) {
  const std::size_t before = size();
  std::vector<std::uint8_t> gone = find_outliers(*tree_, points_, normals_, noise, context);
  const auto found = static_cast<std::size_t>(std::count(gone.begin(), gone.end(), 1));
  if (found > most) {
    std::vector<std::uint8_t> both(size(), 0);
    for (const std::uint32_t i : suspects) both[i] = gone[i];
    remove(both, context);
    return before - size();
  }
  for (int pass = 1; remove(gone, context) && pass < kOutlierPasses; ++pass) {
    gone = find_outliers(*tree_, points_, normals_, noise, context);
  }
  const auto least = static_cast<std::size_t>(kLeastGroup * static_cast<double>(size()));
  remove(find_small_groups(*tree_, normals_, std::max(kFewestPoints, least), context), context);
  return before - size();
}

std::optional<SeenSpace> WorkingPoints::seen_space(double edge, double margin,
                                                   const Context& context) const {
  const std::vector<Vec3> sensors = sensors_of(cloud_);
  if (sensors.empty()) return std::nullopt;
  return std::make_optional<SeenSpace>(cloud_.points, sensors, edge, margin, context);
}

void WorkingPoints::keep_tree() {
  release(cloud_.points), release(cloud_.normals);
  release(points_), release(normals_);
}

void WorkingPoints::carry_attributes(Mesh& mesh, const Context& context) const {
  const std::size_t n = mesh.vertices.size(), first = mesh.attributes.size();
  for (const Attribute& attribute : cloud_.attributes) {
    mesh.attributes.push_back({attribute.name, attribute.type, std::vector<double>(n)});
  }
  if (mesh.attributes.size() == first) return;
  parallel_for(n, 1024, context, {.name = "attributes"}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    std::vector<double> weights;
    const auto blended = [&](const Attribute& attribute) {
      // Where a scanner had no value there may be no number: the others count alone.
      double value = 0, sum = 0;
      for (std::size_t j = 0; j < near.size(); ++j) {
        const double own = attribute.values[tree_->order()[near[j].index]];
        if (!std::isfinite(own)) continue;
        value += weights[j] * own;
        sum += weights[j];
      }
      return value / sum;
    };
    for (std::size_t v = begin; v < end; ++v) {
      tree_->nearest(mesh.vertices[v], kCircle, near);
      // The weight of method 7.5, its support a little beyond the farthest.
      const double support2 = 1.3 * std::max(1e-300, static_cast<double>(near.back().distance2));
      weights.clear();
      for (const Neighbor& p : near) {
        const double rest = 1 - p.distance2 / support2;
        weights.push_back(rest * rest * rest);
      }
      for (std::size_t a = 0; a < cloud_.attributes.size(); ++a) {
        mesh.attributes[first + a].values[v] = blended(cloud_.attributes[a]);
      }
    }
  });
  if (has_one_sensor_) {
    std::erase_if(mesh.attributes, [](const Attribute& attribute) {
      return std::find(kSensorAxes.begin(), kSensorAxes.end(), attribute.name) != kSensorAxes.end();
    });
  }
  // Values keep to their type: whole numbers stay whole, floats floats.
  for (std::size_t a = first; a < mesh.attributes.size(); ++a) {
    Attribute& attribute = mesh.attributes[a];
    if (attribute.type == ScalarType::kFloat64) continue;
    const bool real = attribute.type == ScalarType::kFloat32;
    for (double& value : attribute.values) {
      value = real ? static_cast<double>(static_cast<float>(value)) : std::round(value);
    }
  }
}

}  // namespace rholm
