#include "shape/points/side_balance.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace rholm {
namespace {

constexpr std::size_t kAreaSeeds = 2000;  // chosen: volumes to 2 % of area times size
// The squared distance to the eighth neighbour is the area of eight points, up to a factor.
constexpr std::size_t kDisc = 8;
// Largest area of a point, in medians: it limits an outlier far from all others. Where the density
// falls 30 times, points of the sparse end have 5 medians.
constexpr double kMostOfMedian = 10;
// Largest length of the mean normal of a nearly closed surface: at most a fifth of a sphere is
// missing. It is zero for a closed surface and 0.5 for half a sphere.
constexpr double kNearlyClosed = 0.2;
// Least standard deviations of a volume below zero (chosen: by chance, once
// in thirty thousand solids).
constexpr double kSure = 4;

}  // namespace

SideBalance balance_sides(const PointTree& tree, std::span<const Vec3> points,
                          std::span<const Vec3> normals, const Context& context) {
  const std::size_t n = points.size(), seeds = std::min(n, kAreaSeeds);
  std::vector<double> areas(seeds);
  parallel_for(seeds, 256, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t j = begin; j < end; ++j) {
      tree.nearest_to(j * n / seeds, kDisc + 1, near);
      areas[j] = near.back().distance2;  // up to a common factor
    }
  });
  std::vector<Vec3> some, some_normals;
  for (std::size_t j = 0; j < seeds; ++j) {
    some.push_back(points[j * n / seeds]);
    some_normals.push_back(normals[j * n / seeds]);
  }
  return balance_of(std::move(areas), some, some_normals);
}

SideBalance balance_of(std::vector<double> areas, std::span<const Vec3> points,
                       std::span<const Vec3> normals) {
  const std::size_t seeds = areas.size();
  if (seeds == 0) return {};
  std::vector<double> sorted = areas;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(seeds / 2),
                   sorted.end());
  const double most = kMostOfMedian * sorted[seeds / 2];
  for (double& own : areas) own = std::min(own, most);
  double area = 0;
  Vec3 middle, mean_normal;
  for (std::size_t j = 0; j < seeds; ++j) {
    area += areas[j];
    middle += areas[j] * points[j];
    mean_normal += areas[j] * normals[j];
  }
  SideBalance balance;
  if (!(area > 0)) return balance;
  balance.one_sided = norm(mean_normal) / area;
  middle = middle / area;
  double volume = 0, variance = 0;
  for (std::size_t j = 0; j < seeds; ++j) {
    const double own = areas[j] * dot(points[j] - middle, normals[j]);
    volume += own;
    variance += own * own;
  }
  balance.inwards = balance.one_sided < kNearlyClosed && volume < -kSure * std::sqrt(variance);
  return balance;
}

}  // namespace rholm
