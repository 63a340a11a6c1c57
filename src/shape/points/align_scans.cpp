// Aligns scans of one surface (method 7.13). Layer: shape.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "rholm/points.h"
#include "rholm/topology.h"
#include "shape/points/normals.h"
#include "shape/points/plane_fit.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"
#include "shape/points/scan_motions.h"
#include "shape/points/scan_poses.h"
#include "shape/points/sensors.h"
#include "shape/rigid_motion.h"

namespace rholm {
namespace {

// Number of points of a scan that nearest points are sought in, and number that seek. Chosen: the
// error of six unknowns from a thousand distances is a thirtieth of the distances' error.
constexpr std::size_t kMet = 8000;
constexpr std::size_t kLooking = 2000;
// Scans with fewer points have no reliable normals and stay where they are.
constexpr std::size_t kFewest = 50;
// First reach of pairs, in spacings of all points: scans that are off by three spacings, rms, are
// up to three times this apart.
constexpr double kFirstReach = 9;
// Largest offset along the surface, in spacings of the scan of b: a nearest point farther away
// is at the end of its scan.
constexpr double kAside = 2;
constexpr double kSameSide = 0.8;  // cosine of the normals; chosen: 37 degrees
// Confidence of a normal's sign: fewer than one in ten thousand are wrong (method 7.12).
constexpr double kSure = 0.99;
// Tukey's biweight with 95 % efficiency, and standard deviation of a Gaussian over its median.
constexpr double kTukey = 4.685, kOfMedian = 1.4826;
// Rounds end when the distances change by less than this part of their deviation. New pairs alone
// change them by sqrt(6 scans / pairs) of it, some hundredths.
constexpr double kStill = 0.1;
constexpr int kMostRounds = 60;  // chosen: five rounds are usual

// One scan: some of its points, with normals.
struct Scan {
  std::vector<std::uint32_t> members;  // indices in the cloud
  std::vector<Vec3> points, normals;   // in the order of the tree
  std::optional<PointTree> tree;
  double spacing = 0;  // spacing of these points
  double height = 0;   // median distance of the points from their planes
};

double spacing_of(const PointTree& tree) {
  const std::size_t n = tree.size(), seeds = std::min<std::size_t>(n, 1000);
  std::vector<double> all(seeds);
  std::vector<Neighbor> near;
  for (std::size_t j = 0; j < seeds; ++j) {
    tree.nearest_to(j * n / seeds, kCircle + 1, near);
    all[j] = spacing_of_circle(near.back().distance2);
  }
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(seeds / 2), all.end());
  return all[seeds / 2];
}

// Chooses even points of the scan, with given normals or normals of planes that face the sensors.
void choose_points(const PointCloud& cloud, std::span<const Vec3> sensors, Scan& scan,
                   const Context& context) {
  std::vector<Vec3> all(scan.members.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = cloud.points[scan.members[i]];
  const PointTree tree(all, context);
  std::vector<Vec3> ordered(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) ordered[i] = all[tree.order()[i]];
  const SamplingGaps gaps = find_gaps(tree, ordered, {}, context);
  const auto k = static_cast<std::size_t>(choose_neighbors(tree, ordered, gaps, context));
  const std::size_t n = std::min(all.size(), kMet);
  std::vector<Vec3> normals(n);
  std::vector<double> heights(n);
  parallel_for(n, 256, context, {}, [&](std::size_t begin, std::size_t end) {
    Neighborhood near;
    for (std::size_t j = begin; j < end; ++j) {
      const std::size_t i = j * all.size() / n, given = scan.members[tree.order()[i]];
      near.gather(tree, ordered, i, gaps.scaled(i, k));
      if (!(near.radius > 0)) continue;
      const PlaneFit fit = fit_plane(near.points, near.weights);
      heights[j] = std::sqrt(fit.height) * near.radius;
      normals[j] = cloud.normals.empty() ? fit.normal : normalized(cloud.normals[given]);
      if (cloud.normals.empty() && !sensors.empty() &&
          dot(normals[j], sensors[given] - cloud.points[given]) < 0) {
        normals[j] = -normals[j];
      }
    }
  });
  scan.points.clear(), scan.normals.clear();
  for (std::size_t j = 0; j < n; ++j) {
    if (!(norm(normals[j]) > 0)) continue;
    scan.points.push_back(ordered[j * all.size() / n]);
    scan.normals.push_back(normals[j]);
  }
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  scan.height = *middle;
}

void plant(Scan& scan, const Context& context) {
  scan.tree.emplace(scan.points, context);
  std::vector<Vec3> points, normals;
  for (const std::uint32_t i : scan.tree->order()) {
    points.push_back(scan.points[i]), normals.push_back(scan.normals[i]);
  }
  scan.points = std::move(points), scan.normals = std::move(normals);
  scan.spacing = spacing_of(*scan.tree);
}

// All scans, in their present poses; scans that cannot be moved have no points.
struct Scans {
  std::vector<Scan> scans;
  std::vector<ScanPose> poses;
  Vec3 middle;
  double radius = 0;
  double spacing = 0;  // of all points
  bool sided = false;  // normals have the right sign

  void move(std::span<const RigidMotion> motions, const Context& context);
  std::vector<ScanPair> pairs(double reach, const Context& context) const;
  void add_pairs(std::size_t from, std::size_t to, double reach, std::size_t begin, std::size_t end,
                 std::vector<ScanPair>& found) const;
};

void Scans::move(std::span<const RigidMotion> motions, const Context& context) {
  for (std::size_t k = 0; k < scans.size(); ++k) {
    poses[k].move(motions[k]);
    Scan& scan = scans[k];
    for (Vec3& point : scan.points) point = motions[k].point(point);
    for (Vec3& normal : scan.normals) normal = motions[k].direction(normal);
    if (!scan.points.empty()) plant(scan, context);
  }
}

// Pairs use the normal n_a + n_b, along which the distance of a and b is zero if both lie on one
// sphere. Unlike the distance from a plane, it does not grow with their distance along the surface.
void Scans::add_pairs(std::size_t from, std::size_t to, double reach, std::size_t begin,
                      std::size_t end, std::vector<ScanPair>& found) const {
  const Scan &looking = scans[from], &met = scans[to];
  const double weight =
      1 / (looking.height * looking.height + met.height * met.height + 1e-12 * spacing * spacing);
  const std::size_t n = std::min(looking.points.size(), kLooking);
  std::vector<Neighbor> near;
  for (std::size_t j = begin; j < end; ++j) {
    const std::size_t i = j * looking.points.size() / n;
    const Vec3 a = looking.points[i];
    met.tree->nearest(a, 1, near);
    const Vec3 b = met.points[near[0].index];
    const double cosine = dot(looking.normals[i], met.normals[near[0].index]);
    if (!(cosine > kSameSide)) continue;
    const Vec3 normal = normalized(looking.normals[i] + met.normals[near[0].index]);
    const double distance = dot(a - b, normal);
    if (std::abs(distance) > reach) continue;
    if (norm(a - b - distance * normal) > kAside * met.spacing) continue;
    found.push_back(
        {static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to), a, b, normal, weight});
  }
}

bool near(const Bounds& a, const Bounds& b, double reach) {
  const Vec3 low = a.min - b.max, high = b.min - a.max;
  return std::max({low.x, low.y, low.z, high.x, high.y, high.z}) <= reach;
}

std::vector<ScanPair> Scans::pairs(double reach, const Context& context) const {
  // Chunk of points of one scan that seek nearest points of another scan.
  struct Chunk {
    std::size_t from, to, begin, end;
  };
  constexpr std::size_t kChunk = 256;
  std::vector<Bounds> boxes;
  boxes.reserve(scans.size());
  for (const Scan& scan : scans) boxes.push_back(bounds(scan.points));
  std::vector<Chunk> chunks;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    for (std::size_t j = 0; j < scans.size(); ++j) {
      if (i == j || scans[i].points.empty() || scans[j].points.empty()) continue;
      if (!near(boxes[i], boxes[j], reach)) continue;
      const std::size_t n = std::min(scans[i].points.size(), kLooking);
      for (std::size_t b = 0; b < n; b += kChunk)
        chunks.push_back({i, j, b, std::min(n, b + kChunk)});
    }
  }
  std::vector<std::vector<ScanPair>> found(chunks.size());
  parallel_for(chunks.size(), 1, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      add_pairs(chunks[c].from, chunks[c].to, reach, chunks[c].begin, chunks[c].end, found[c]);
    }
  });
  std::vector<ScanPair> all;
  for (const std::vector<ScanPair>& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

// Returns the standard deviation of the distances, assuming that most are Gaussian.
double deviation(std::span<const ScanPair> pairs) {
  if (pairs.empty()) return 0;
  std::vector<double> all;
  for (const ScanPair& pair : pairs) all.push_back(std::abs(pair.distance()));
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return kOfMedian * *middle;
}

void weigh(std::vector<ScanPair>& pairs, double sigma) {
  for (ScanPair& pair : pairs) {
    const double t = pair.distance() / (kTukey * sigma), rest = std::max(0.0, 1 - t * t);
    pair.weight *= sigma > 0 ? rest * rest : 1;
  }
}

// Returns the weighted root mean square of the changes.
double change_of_distances(std::span<const ScanPair> pairs, std::span<const RigidMotion> motions) {
  double squares = 0, weights = 0;
  for (const ScanPair& pair : pairs) {
    ScanPair moved = pair;
    moved.a = motions[pair.from].point(pair.a), moved.b = motions[pair.to].point(pair.b);
    const double change = moved.distance() - pair.distance();
    squares += pair.weight * change * change;
    weights += pair.weight;
  }
  return weights > 0 ? std::sqrt(squares / weights) : 0;
}

// Moves the scans until the distances no longer change.
void bring_together(Scans& scans, ScanAlignment& result, const Context& context) {
  double reach = kFirstReach * scans.spacing;
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<ScanPair> pairs = scans.pairs(reach, context);
    const double sigma = deviation(pairs);
    if (round == 0) result.distance_before = sigma;
    result.distance = sigma;
    result.pairs = pairs.size();
    if (pairs.empty()) return;
    weigh(pairs, sigma);
    std::vector<ScanBody> bodies;
    for (const Scan& scan : scans.scans) {
      bodies.push_back(body_of(scan.points, scans.middle, scans.radius));
      bodies.back().points = static_cast<double>(scan.members.size());
    }
    const std::vector<RigidMotion> motions =
        solve_motions(pairs, bodies, scans.middle, scans.radius);
    scans.move(motions, context);
    if (change_of_distances(pairs, motions) <= kStill * sigma) return;
    reach = std::min(reach, std::max(kTukey * sigma, scans.spacing));
  }
}

// Finds signs of normals from all scans together if neither normals nor sensors give them, because
// a thin part has another sheet within reach. Some points of each scan are oriented; the others
// take the sign of the nearest one.
void find_sides(Scans& scans, const Context& context) {
  PointCloud some;
  for (const Scan& scan : scans.scans) {
    const std::size_t n = std::min(scan.points.size(), kLooking);
    for (std::size_t j = 0; j < n; ++j) {
      some.points.push_back(scan.points[j * scan.points.size() / n]);
      some.normals.push_back(scan.normals[j * scan.points.size() / n]);
    }
  }
  if (some.points.empty()) return;
  orient(some, {.keep_directions = true, .keep_outliers = true, .confidence = true}, context);
  const std::vector<double>& sure = find_attribute(some.attributes, "confidence")->values;
  std::size_t first = 0;
  for (Scan& scan : scans.scans) {
    const std::size_t n = std::min(scan.points.size(), kLooking);
    if (n == 0) continue;
    const PointTree known(std::span(some.points).subspan(first, n), context);
    std::vector<Neighbor> near;
    for (std::size_t i = 0; i < scan.points.size(); ++i) {
      known.nearest(scan.points[i], 1, near);
      const std::size_t of = first + known.order()[near[0].index];
      if (dot(scan.normals[i], some.normals[of]) < 0) scan.normals[i] = -scan.normals[i];
      // A pair requires a cosine above kSameSide, which a zero normal never reaches.
      if (sure[of] < kSure) scan.normals[i] = {};
    }
    first += n;
  }
}

}  // namespace

double ScanPoses::move(PointCloud& cloud) const {
  const Attribute* const scan = find_attribute(cloud.attributes, "scan");
  if (poses.empty() || scan == nullptr) return 0;
  std::vector<Vec3> sensors = sensors_of(cloud);
  double squares = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const auto label = std::lower_bound(labels.begin(), labels.end(), scan->values[i]);
    if (label == labels.end() || *label != scan->values[i]) continue;
    const ScanPose& pose = poses[static_cast<std::size_t>(label - labels.begin())];
    const auto moved = [&](const Vec3& p) { return pose.origin + pose.direction(p - middle); };
    const Vec3 at = moved(cloud.points[i]);
    squares += dot(at - cloud.points[i], at - cloud.points[i]);
    cloud.points[i] = at;
    if (!cloud.normals.empty()) cloud.normals[i] = pose.direction(cloud.normals[i]);
    if (!sensors.empty()) sensors[i] = moved(sensors[i]);
  }
  if (!sensors.empty()) set_sensors(cloud, sensors);
  return squares;
}

ScanPoses find_scan_poses(const PointCloud& cloud, const Context& context) {
  ScanPoses result;
  const Attribute* const scan = find_attribute(cloud.attributes, "scan");
  if (scan == nullptr || !add_scans(scan->values, result.labels)) return {};
  const std::size_t n = result.alignment.scans = result.labels.size();
  if (n < 2) return result;
  Scans scans;
  scans.scans.resize(n);
  for (std::uint32_t i = 0; i < cloud.points.size(); ++i) {
    const auto label =
        std::lower_bound(result.labels.begin(), result.labels.end(), scan->values[i]);
    scans.scans[static_cast<std::size_t>(label - result.labels.begin())].members.push_back(i);
    scans.middle += cloud.points[i] / static_cast<double>(cloud.points.size());
  }
  double squares = 0;
  for (const Vec3& p : cloud.points) squares += dot(p - scans.middle, p - scans.middle);
  scans.radius = std::sqrt(squares / static_cast<double>(cloud.points.size()));
  scans.poses.assign(n, {.origin = scans.middle});
  scans.spacing = spacing_of(PointTree(cloud.points, context));
  const std::vector<Vec3> sensors = sensors_of(cloud);
  scans.sided = !cloud.normals.empty() || !sensors.empty();
  for (Scan& some : scans.scans) {
    if (some.members.size() < kFewest) continue;
    choose_points(cloud, sensors, some, context);
    if (!some.points.empty()) plant(some, context);
  }
  if (!scans.sided) find_sides(scans, context);
  bring_together(scans, result.alignment, context);
  result.middle = scans.middle;
  if (result.alignment.pairs > 0) result.poses = std::move(scans.poses);
  return result;
}

ScanAlignment align_scans(PointCloud& cloud, const Context& context) {
  validate(cloud);
  const ScanPoses poses = find_scan_poses(cloud, context);
  ScanAlignment result = poses.alignment;
  if (poses.poses.empty()) return result;
  result.moved = std::sqrt(poses.move(cloud) / static_cast<double>(cloud.points.size()));
  return result;
}

}  // namespace rholm
