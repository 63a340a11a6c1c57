#include "model/oriented_points.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/refuse.h"

namespace rholm {
namespace {

constexpr std::size_t kAreaSeeds = 2000;  // chosen: volumes to 2 % of area times size
// Squared, the disc around a point to its eighth neighbour stands for eight points' areas.
constexpr std::size_t kDisc = 8;
// An outlier far from all others stands for no more of the surface than this many typical points;
// where density falls 30 times, the sparse end's stand for 5.
constexpr double kMostOfMedian = 10;
// Of a closed surface the mean normal is zero, of half a sphere 0.5. Below this at most a fifth of
// a sphere is missing.
constexpr double kNearlyClosed = 0.2;
// Standard deviations that a volume is below zero (chosen: a solid that has none by chance, one in
// thirty thousand).
constexpr double kSure = 4;

}  // namespace

void check_oriented(const PointCloud& cloud) {
  validate(cloud);
  if (cloud.normals.size() != cloud.points.size()) {
    refuse("points need normals that point outwards: 'rholm orient' gives them");
  }
}

bool face_inwards(const PointTree& tree, std::span<const Vec3> points,
                  std::span<const Vec3> normals, const Context& context) {
  const std::size_t n = points.size(), seeds = std::min(n, kAreaSeeds);
  std::vector<double> areas(seeds);
  parallel_for(seeds, 256, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t j = begin; j < end; ++j) {
      tree.nearest_to(j * n / seeds, kDisc + 1, near);
      areas[j] = near.back().distance2;  // to a common factor
    }
  });
  std::vector<double> sorted = areas;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(seeds / 2),
                   sorted.end());
  const double most = kMostOfMedian * sorted[seeds / 2];
  for (double& own : areas) own = std::min(own, most);
  double area = 0;
  Vec3 middle, mean_normal;
  for (std::size_t j = 0; j < seeds; ++j) {
    area += areas[j];
    middle += areas[j] * points[j * n / seeds];
    mean_normal += areas[j] * normals[j * n / seeds];
  }
  if (!(norm(mean_normal) < kNearlyClosed * area)) return false;
  middle = middle / area;
  double volume = 0, variance = 0;
  for (std::size_t j = 0; j < seeds; ++j) {
    const double own = areas[j] * dot(points[j * n / seeds] - middle, normals[j * n / seeds]);
    volume += own;
    variance += own * own;
  }
  return volume < -kSure * std::sqrt(variance);
}

OrientedPoints oriented_points(const std::vector<Vec3>& points, const std::vector<Vec3>& normals) {
  OrientedPoints result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(norm(normals[i]) > 0)) continue;
    result.points.push_back(points[i]);
    result.normals.push_back(normalized(normals[i]));
  }
  return result;
}

bool turn_outwards(OrientedPoints& samples, const Context& context) {
  const PointTree tree(samples.points, context);
  const OrientedPoints sorted = [&] {
    OrientedPoints result;
    for (const std::uint32_t i : tree.order()) {
      result.points.push_back(samples.points[i]);
      result.normals.push_back(samples.normals[i]);
    }
    return result;
  }();
  if (!face_inwards(tree, sorted.points, sorted.normals, context)) return false;
  for (Vec3& normal : samples.normals) normal = -normal;
  return true;
}

}  // namespace rholm
