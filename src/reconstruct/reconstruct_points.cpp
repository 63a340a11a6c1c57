#include "reconstruct/reconstruct_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "base/large_vector.h"
#include "base/parallel.h"
#include "reconstruct/output/carry_attributes.h"
#include "reconstruct/points/reconstruct_rules.h"
#include "rholm/points.h"
#include "rholm/topology.h"
#include "shape/on_line.h"
#include "shape/points/local_shape.h"
#include "shape/points/outliers.h"
#include "shape/points/sensors.h"
#include "shape/points/side_balance.h"
#include "shape/points/strays.h"

namespace rholm {
namespace {

constexpr std::size_t kSpacingSeeds = 2000;
// Of even random points the tenth lies at 0.8 of the median; a finer part of uneven ones below.
constexpr double kTenthOfEven = 0.8;
// Points that speak for the sides of all components: as turn_outwards() asks of one.
constexpr std::size_t kSignSeeds = 2000;

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

}  // namespace

WorkingPoints::WorkingPoints(PointCloud cloud, const ReconstructOptions& options,
                             ReconstructReport& report, const Context& context)
    : cloud_(std::move(cloud)) {
  report.points = cloud_.points.size();
  if (!options.keep_outliers && lists_fit(cloud_)) {
    const std::vector<std::uint8_t> far = find_far_strays(cloud_.points);
    report.outliers = static_cast<std::size_t>(std::count(far.begin(), far.end(), 1));
    if (report.outliers > 0) keep_points(cloud_, [&](std::size_t i) { return far[i] == 0; });
  }
  clean(cloud_, context);
  if (options.sensor) put_sensor(*options.sensor);
  bool directed = std::any_of(cloud_.normals.begin(), cloud_.normals.end(),
                              [](const Vec3& n) { return norm(n) > 0; });
  if (directed) drop_zero_normals(cloud_);
  if (!directed) cloud_.normals.clear();
  if (!options.keep_scans) report.scans = align_scans(cloud_, context);
  check_points();
  order_points(context);
  if (!options.keep_outliers) report.outliers += remove_strays(context);
  if (options.confidence) {
    // Of normals that are given nothing is known; orient() says what it knows of its own.
    const std::vector<double> sure(cloud_.points.size(), 1.0);
    set_attribute(cloud_.attributes, {"confidence", ScalarType::kFloat32, sure});
  }
  if (directed) {
    const LocalShape shape = look_at_shape(context);
    report.crooked_normals = shape.crooked;
    if (shape.crooked > kMostCrooked) directed = false;
  }
  if (!directed) compute_normals(options, report, context);
  report.dropped_points = report.points - report.outliers - cloud_.points.size();
  if (directed) {
    mend_normals(options, report, context);
  } else {
    const SignPieces pieces = find_sign_pieces(*tree_, points_, normals_, gaps_, {}, context);
    note_contradictions(pieces, check_signs(all_of(pieces), {}, context), false, report);
  }
  if (options.holes == HolePolicy::kFill) {
    check_sides(balance_sides(*tree_, points_, normals_, context), size());
  }
}

void WorkingPoints::compute_normals(const ReconstructOptions& options, ReconstructReport& report,
                                    const Context& context) {
  cloud_.normals.clear();
  neighbors_ = {};  // of gaps by places alone
  // Strays are gone, if they shall.
  const OrientOptions wanted{.keep_outliers = true, .confidence = options.confidence};
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
  look_at_shape(context);
}

LocalShape WorkingPoints::look_at_shape(const Context& context) {
  const LocalShape shape = rholm::look_at_shape(*tree_, points_, normals_, context);
  check_shape(shape, size());
  around_ = area_neighbors(shape.neighbors);
  return shape;
}

double WorkingPoints::area_at(std::size_t i, std::vector<Neighbor>& near) const {
  const std::size_t around = std::min(gaps_.scaled(i, around_), size() - 1);
  tree_->nearest_to(i, around + 1, near);
  return std::numbers::pi * near.back().distance2 / static_cast<double>(around);
}

void WorkingPoints::note_contradictions(const SignPieces& pieces, const SignCheck& check,
                                        bool after, ReconstructReport& report) const {
  const std::vector<std::uint32_t> found = contradicting_points(pieces, 0, check, after);
  report.contradicting_normals = found.size() + (after ? check.undecided : 0);
  for (std::size_t k = 0; k < std::min(found.size(), kNamedPoints); ++k) {
    report.contradictions.push_back(points_[found[k]]);
  }
}

void WorkingPoints::mend_normals(const ReconstructOptions& options, ReconstructReport& report,
                                 const Context& context) {
  const SignPieces pieces =
      find_sign_pieces(*tree_, points_, normals_, gaps_, {}, context, std::move(neighbors_));
  const MendedSigns mended = mend_signs(all_of(pieces), sign_samples(pieces, context),
                                        options.holes == HolePolicy::kFill, context);
  note_contradictions(pieces, mended.check, true, report);
  report.inward_normals = mended.inward;
  report.turned_normals = mended.all_inward;
  if (!mended.all_inward) report.mended_normals = mended.n_turned;
  if (mended.n_turned == 0) return;
  for (std::size_t i = 0; i < size(); ++i) {
    if (mended.turned[pieces.piece[i]] == 0) continue;
    normals_[i] = -normals_[i];
    Vec3& given = cloud_.normals[tree_->order()[i]];
    given = -given;
  }
}

std::vector<SignSample> WorkingPoints::sign_samples(const SignPieces& pieces,
                                                    const Context& context) const {
  const std::size_t n = size(), m = std::min(n, kSignSeeds);
  std::vector<SignSample> samples(m);
  parallel_for(m, 256, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t j = begin; j < end; ++j) {
      const std::size_t i = j * n / m;
      samples[j] = {.at = points_[i],
                    .normal = normals_[i],
                    .area = area_at(i, near) * static_cast<double>(n) / static_cast<double>(m),
                    .piece = pieces.piece[i]};
      tree_->nearest_to(i, kCircle + 1, near);
      samples[j].disc = near.back().distance2;
    }
  });
  return samples;
}

void WorkingPoints::check_points() {
  diagonal_ = bounds(cloud_.points).diagonal();
  check_spread(cloud_.points.size(), diagonal_);
  if (lie_on_line(cloud_.points, kLine * diagonal_)) refuse_one_line(cloud_.points.size());
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
  neighbors_.clear();
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
    // Only signs of given normals are looked at with these gaps.
    std::vector<std::uint32_t> neighbors;
    auto* const wanted = normals_.empty() ? nullptr : &neighbors;
    if (!remove(find_strays(*tree_, points_, gaps_, context, wanted), context)) {
      neighbors_ = std::move(neighbors);
      break;
    }
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
      areas[j] = area_at(i, near);
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
  return spacing_around(*tree_, gaps_, place, near);
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

Crossings WorkingPoints::crossings(double noise, const Context& context) const {
  const CrossingSearch search{.n = size(), .diagonal = diagonal_, .noise = noise};
  return find_crossings(*tree_, points_, gaps_, {}, search, context);
}

WallPatches WorkingPoints::patches(const Context& context) const {
  return choose_patches(*tree_, points_, {}, size(), around_, context);
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
  remove(find_small_groups(*tree_, normals_, least_group(size()), context), context);
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
  rholm::carry_attributes(*tree_, cloud_.attributes, mesh, context);
  if (has_one_sensor_) {
    std::erase_if(mesh.attributes, [](const Attribute& attribute) {
      return std::find(kSensorAxes.begin(), kSensorAxes.end(), attribute.name) != kSensorAxes.end();
    });
  }
}

}  // namespace rholm
