#include "shape/points/outliers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/disjoint_sets.h"
#include "base/parallel.h"

namespace rholm {
namespace {

constexpr std::size_t kNeighbours = 16;
// Cosine of 45 degrees, within which normals agree. Among 16 random normals 2.3 agree, so fewer
// than 5 are chance (95 %). A point on a corner of three faces still has about 5 of its own face.
constexpr double kAgree = 0.7;
constexpr std::size_t kFewest = 5;
// Largest mean distance from planes of agreeing neighbours, relative to the neighbours' distance.
constexpr double kOff = 0.5;
// The distance to the 8th neighbour, over the neighbours' own distance, that makes an outlier. On a
// surface it varies by a tenth, however uneven.
constexpr std::size_t kEighth = 8;
constexpr double kIsolated = 3;
// Number of points tested for wrong normals, and length of the mean of the normals around
// from which on these agree with each other. On a flat surface with a tenth of random normals
// it is 0.9, with a fifth 0.8.
constexpr std::size_t kSeeds = 2000;
constexpr double kOneMind = 0.8;
struct Scan {
  const PointTree& tree;
  std::span<const Vec3> points, normals;
  double noise;
  std::vector<float> spacing;  // distance to the eighth neighbour
};

bool is_outlier(const Scan& scan, std::size_t i, const std::vector<Neighbor>& near,
                std::vector<float>& spacings) {
  std::size_t agreeing = 0;
  double off = 0, distance = 0;
  spacings.clear();
  for (const Neighbor& n : near) {
    spacings.push_back(scan.spacing[n.index]);
    if (dot(scan.normals[n.index], scan.normals[i]) < kAgree) continue;
    ++agreeing;
    off += std::abs(dot(scan.normals[n.index], scan.points[i] - scan.points[n.index]));
    distance += std::sqrt(static_cast<double>(n.distance2));
  }
  if (agreeing < std::min(kFewest, near.size())) return true;
  if (off > kOff * distance + 3 * scan.noise * static_cast<double>(agreeing)) return true;
  const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return scan.spacing[i] > kIsolated * *middle + 3 * scan.noise;
}

}  // namespace

std::vector<std::uint8_t> find_outliers(const PointTree& tree, std::span<const Vec3> points,
                                        std::span<const Vec3> normals, double noise,
                                        const Context& context) {
  const std::size_t n = points.size();
  constexpr std::size_t kGrain = 2048;
  std::vector<std::uint8_t> flags(n, 0);
  Scan scan{tree, points, normals, noise, std::vector<float>(n)};
  const auto for_points = [&](const auto& visit) {
    parallel_for(n, kGrain, context, {.name = "outliers"}, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbor> near;
      std::vector<float> spacings;
      for (std::size_t i = begin; i < end; ++i) visit(i, near, spacings);
    });
  };
  for_points([&](std::size_t i, std::vector<Neighbor>& near, std::vector<float>&) {
    tree.nearest_to(i, kEighth + 1, near);
    scan.spacing[i] = std::sqrt(near.back().distance2);
  });
  for_points([&](std::size_t i, std::vector<Neighbor>& near, std::vector<float>& spacings) {
    tree.nearest_to(i, kNeighbours + 1, near);
    std::erase_if(near, [i](const Neighbor& other) { return other.index == i; });
    flags[i] = !near.empty() && is_outlier(scan, i, near, spacings) ? 1 : 0;
  });
  return flags;
}

bool has_wrong_normal(const PointTree& tree, std::span<const Vec3> normals, std::size_t point,
                      std::vector<Neighbor>& near) {
  tree.nearest_to(point, kNeighbours + 1, near);
  Vec3 sum;
  for (const Neighbor& other : near) {
    if (other.index != point) sum += normals[other.index];
  }
  const bool agreed = norm(sum) > kOneMind * static_cast<double>(near.size() - 1);
  return agreed && dot(normals[point], normalized(sum)) < kAgree;
}

double share_of_wrong_normals(const PointTree& tree, std::span<const Vec3> normals,
                              const Context& context) {
  const std::size_t n = normals.size(), seeds = std::min(n, kSeeds);
  if (n <= kNeighbours) return 0;
  std::vector<std::uint8_t> wrong(seeds);
  parallel_for(seeds, 128, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t s = begin; s < end; ++s) {
      wrong[s] = has_wrong_normal(tree, normals, s * n / seeds, near) ? 1 : 0;
    }
  });
  const auto found = std::count(wrong.begin(), wrong.end(), 1);
  return static_cast<double>(found) / static_cast<double>(seeds);
}

void for_links_of_groups(const PointTree& tree, std::span<const Vec3> normals,
                         const std::function<void(std::uint32_t, std::uint32_t)>& visit,
                         const Context& context) {
  const std::size_t n = normals.size();
  std::vector<float> spacing(n);
  std::vector<std::array<std::uint32_t, kEighth>> links(n);
  parallel_for(n, 2048, context, {.name = "outliers"}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t i = begin; i < end; ++i) {
      tree.nearest_to(i, kEighth + 1, near);
      spacing[i] = std::sqrt(near.back().distance2);
      links[i].fill(static_cast<std::uint32_t>(i));
      for (std::size_t j = 0; j < std::min(kEighth, near.size()); ++j) links[i][j] = near[j].index;
    }
  });
  for (std::uint32_t i = 0; i < n; ++i) {
    for (const std::uint32_t j : links[i]) {
      // Compares with both spacings: a single point is far from neighbours that are close together.
      const bool close = spacing[i] < kIsolated * spacing[j] && spacing[j] < kIsolated * spacing[i];
      if (close && dot(normals[i], normals[j]) > 0.5) visit(i, j);
    }
  }
}

std::vector<std::uint8_t> find_small_groups(const PointTree& tree, std::span<const Vec3> normals,
                                            std::size_t least, const Context& context) {
  const std::size_t n = normals.size();
  DisjointSets groups(n);
  const auto unite = [&](std::uint32_t i, std::uint32_t j) { groups.unite(i, j); };
  for_links_of_groups(tree, normals, unite, context);
  std::vector<std::uint32_t> sizes(n, 0);
  for (std::uint32_t i = 0; i < n; ++i) ++sizes[groups.find(i)];
  std::vector<std::uint8_t> flags(n);
  for (std::uint32_t i = 0; i < n; ++i) flags[i] = sizes[groups.find(i)] < least ? 1 : 0;
  return flags;
}

}  // namespace rholm
