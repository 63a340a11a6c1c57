#include "shape/points/isolated_points.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "base/aligned_array.h"
#include "base/parallel.h"
#include "base/shared_sets.h"
#include "shape/points/members.h"
#include "shape/points/normals.h"
#include "shape/points/plane_fit.h"

namespace rholm {
namespace {

constexpr std::size_t kEighth = 8;
constexpr std::size_t kLinks = 8;  // half of them are neighbours in the point's row
static_assert(kLinks <= kGraphNeighbors, "neighbours of the graph are enough for links");
// Two points are of one group if their distance is at most this times the distance to the eighth
// neighbour of either, 2.4 spacings. One even random point in 10^8 is alone.
constexpr double kReach = 1.5;
// Largest growth of the spacing from a point to its neighbours on a surface. Outliers have larger
// distances among each other, but seen from the surface they are alone.
constexpr float kGrows = 1.5f;
constexpr int kSweeps = 40;              // 1.5^40: a factor of a hundred million
constexpr std::size_t kLeastGroup = 16;  // a smaller group has no surface of its own
// Largest thickness of a surface: the least over the largest extent of 16 neighbours, squared,
// median over points. Random points in a volume have 0.37. A sheet with noise of 0, 0.25, 0.5, 1
// spacings has 0.00, 0.03, 0.11, 0.25. Groups of outliers, which are chains, have less than a
// volume: a limit of 0.25 misses a fifth of the groups that 0.2 finds.
constexpr std::size_t kAround = 16;
constexpr double kVolume = 0.2;
// Limits for single points. A sparse point in the plane of its neighbours is no outlier.
// Distance to other points, over the distance to their eighth neighbours.
constexpr double kFar = 10;
// Distance from the plane of the neighbours, relative to their radius.
constexpr double kOff = 0.25;
// Squared thickness of the neighbours, over their squared length.
constexpr double kThick = 0.05;
constexpr double kThinner = 1.5;  // distance to the eighth neighbour over that of the largest group
constexpr std::size_t kAsked = 200;

// Limits of find_far_isolated_points().
constexpr std::size_t kBeyond = 200, kFewestForBox = 32;
constexpr double kFarOutside = 20;

float median(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Groups {
 public:
  Groups(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
         const Context& context, std::vector<std::uint32_t>* neighbors)
      : tree_(tree), points_(points), context_(context), eighth_(points.size()) {
    if (neighbors != nullptr) neighbors->resize(points.size() * kGraphNeighbors);
    find_links(gaps, neighbors);
  }

  std::vector<std::uint8_t> isolated() const {
    const std::size_t n = points_.size();
    std::vector<std::uint8_t> flags(n, 0);
    // Tests single points and small groups among all points.
    const std::vector<std::uint32_t> near = join(eighth_);
    const Members groups(near, n);
    for (std::uint32_t i = 0; i < n; ++i) {
      if (groups.size(near[i]) >= kLeastGroup) continue;
      if (is_far(i, near) || is_off(i)) flags[i] = 1;
    }
    // Tests groups as seen from the surface.
    const std::vector<std::uint32_t> steady = join(steady_ways());
    const Members seen(steady, n);
    std::uint32_t largest = 0;
    for (std::uint32_t g = 0; g < n; ++g) {
      if (seen.size(g) > seen.size(largest)) largest = g;
    }
    const float own = median_way(seen.of(largest));
    for (std::uint32_t g = 0; g < n; ++g) {
      const std::span<const std::uint32_t> group = seen.of(g);
      if (group.size() < kLeastGroup) {
        for (const std::uint32_t i : group) {
          if (is_off(i)) flags[i] = 1;
        }
      } else if (g != largest && median_way(group) > kThinner * own &&
                 fills_volume(group, steady)) {
        for (const std::uint32_t i : group) flags[i] = 1;
      }
    }
    return flags;
  }

 private:
  void find_links(const SamplingGaps& gaps, std::vector<std::uint32_t>* neighbors) {
    const std::size_t wanted = neighbors != nullptr ? kGraphNeighbors : kLinks;
    links_ = AlignedArray<std::array<Neighbor, kLinks>>(points_.size());
    parallel_for(points_.size(), 1024, context_, {.name = "outliers"},
                 [&](std::size_t begin, std::size_t end) {
                   std::vector<Neighbor> near;
                   for (std::size_t i = begin; i < end; ++i) {
                     const std::size_t stride = gaps.stride(i);
                     tree_.nearest_to(i, stride * wanted + 1, near);
                     const std::size_t last = std::min(stride * kEighth, near.size() - 1);
                     eighth_[i] = std::sqrt(near[last].distance2);
                     links_[i].fill({0, static_cast<std::uint32_t>(i)});
                     for (std::size_t j = 0; j < kLinks; ++j) {
                       const std::size_t place = j < kLinks / 2 ? j + 1 : (j + 1) * stride;
                       if (place < near.size()) links_[i][j] = near[place];
                     }
                     if (neighbors != nullptr) {
                       keep_graph_neighbors(i, stride, near, *neighbors);
                     }
                   }
                 });
  }

  template <typename Visit>
  void for_points(const Visit& visit) const {
    parallel_for(points_.size(), 1024, context_, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) visit(static_cast<std::uint32_t>(i));
    });
  }

  // Groups points whose links are within reach; a group's number is its first point.
  std::vector<std::uint32_t> join(const std::vector<float>& ways) const {
    SharedSets sets(points_.size());
    for_points([&](std::uint32_t i) {
      for (const Neighbor& other : links_[i]) {
        const double reach = kReach * std::min(ways[i], ways[other.index]);
        if (other.distance2 <= reach * reach) sets.unite(i, other.index);
      }
    });
    std::vector<std::uint32_t> group(points_.size());
    for_points([&](std::uint32_t i) { group[i] = sets.find(i); });
    return group;
  }

  // Returns distances to eighth neighbours, limited to kGrows times the neighbours' distances.
  std::vector<float> steady_ways() const {
    std::vector<float> ways = eighth_, shorter = ways;
    std::atomic<bool> changed = true;
    for (int sweep = 0; changed && sweep < kSweeps; ++sweep) {
      changed = false;
      for_points([&](std::uint32_t i) {
        for (const Neighbor& other : links_[i]) {
          shorter[i] = std::min(shorter[i], kGrows * ways[other.index]);
        }
        if (shorter[i] < ways[i]) changed = true;
      });
      ways = shorter;
    }
    return ways;
  }

  // Returns true if the nearest point of another group is far, compared with its own neighbours.
  bool is_far(std::uint32_t i, std::span<const std::uint32_t> group_of) const {
    std::vector<Neighbor> near;
    tree_.nearest_to(i, 2 * kLeastGroup, near);
    for (const Neighbor& other : near) {
      if (group_of[other.index] == group_of[i]) continue;
      const double far = kFar * eighth_[other.index];
      return other.distance2 > far * far;
    }
    return true;
  }

  // Returns true if the point and its neighbours have no common plane.
  bool is_off(std::uint32_t i) const {
    std::vector<Neighbor> near;
    tree_.nearest_to(i, kAround + 1, near);
    const double radius = std::sqrt(near.back().distance2);
    std::vector<Vec3> others;
    Vec3 middle;
    for (const Neighbor& other : near) {
      if (other.index == i) continue;
      others.push_back((points_[other.index] - points_[i]) / radius);
      middle += others.back() / static_cast<double>(near.size() - 1);
    }
    const PlaneFit plane = fit_plane(others, std::vector<double>(others.size(), 1.0));
    return plane.height > kThick * plane.length || std::abs(dot(middle, plane.normal)) > kOff;
  }

  // Returns some points of a group, evenly spread.
  static std::vector<std::uint32_t> some_of(std::span<const std::uint32_t> group) {
    std::vector<std::uint32_t> some(std::min(group.size(), kAsked));
    for (std::size_t k = 0; k < some.size(); ++k) some[k] = group[k * group.size() / some.size()];
    return some;
  }

  float median_way(std::span<const std::uint32_t> group) const {
    std::vector<float> ways;
    for (const std::uint32_t i : some_of(group)) ways.push_back(eighth_[i]);
    return median(std::move(ways));
  }

  // Returns true if the neighbours of the group's points, within the group, have no plane.
  bool fills_volume(std::span<const std::uint32_t> group,
                    std::span<const std::uint32_t> group_of) const {
    std::vector<float> thickness;
    std::vector<Neighbor> near;
    for (const std::uint32_t i : some_of(group)) {
      std::vector<Vec3> own;
      tree_.nearest_to(i, 8 * kAround, near);
      for (const Neighbor& other : near) {
        if (group_of[other.index] != group_of[i] || own.size() == kAround) continue;
        own.push_back((points_[other.index] - points_[i]) / std::sqrt(near.back().distance2));
      }
      if (own.size() < kAround / 2) continue;
      const PlaneFit plane = fit_plane(own, std::vector<double>(own.size(), 1.0));
      if (plane.length > 0) thickness.push_back(static_cast<float>(plane.height / plane.length));
    }
    return thickness.empty() || median(thickness) > kVolume;
  }

  const PointTree& tree_;
  std::span<const Vec3> points_;
  const Context& context_;
  AlignedArray<std::array<Neighbor, kLinks>> links_;
  std::vector<float> eighth_;  // distance to the eighth neighbour; in rows, to the row's stride
};

// Returns true if no point is far: each outer quarter of the box, along its longest side, has more
// points than find_far_ball() leaves out. Then the box of that function is at least half as long.
bool is_compact(std::span<const Vec3> points) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 low{kInfinity, kInfinity, kInfinity}, high = -low;
  std::size_t n = 0;
  for (const Vec3& p : points) {
    if (!is_finite(p)) continue;
    ++n;
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 size = high - low;
  double Vec3::*axis = size.x >= size.y ? &Vec3::x : &Vec3::y;
  if (size.z > size.*axis) axis = &Vec3::z;
  const double quarter = size.*axis / 4, from = low.*axis + quarter, to = high.*axis - quarter;
  std::size_t below = 0, above = 0;
  for (const Vec3& p : points) {
    if (!is_finite(p)) continue;
    below += p.*axis < from;
    above += p.*axis > to;
  }
  return std::min(below, above) > std::max<std::size_t>(1, n / kBeyond);
}

}  // namespace

FarBall find_far_ball(std::span<const Vec3> points) {
  Vec3 lower, upper;
  std::vector<double> values;
  for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    values.clear();
    for (const Vec3& p : points) {
      if (is_finite(p)) values.push_back(p.*axis);
    }
    const std::size_t beyond = std::max<std::size_t>(1, values.size() / kBeyond);
    if (values.size() < kFewestForBox) return {};
    const auto low = values.begin() + static_cast<std::ptrdiff_t>(beyond);
    std::nth_element(values.begin(), low, values.end());
    lower.*axis = *low;
    const auto high = values.end() - static_cast<std::ptrdiff_t>(beyond) - 1;
    std::nth_element(values.begin(), high, values.end());
    upper.*axis = *high;
  }
  const Vec3 middle = 0.5 * lower + 0.5 * upper;
  const double diagonal = norm(upper - middle) * 2;
  return {.middle = middle, .radius = kFarOutside * diagonal};
}

std::vector<std::uint8_t> find_far_isolated_points(std::span<const Vec3> points) {
  std::vector<std::uint8_t> flags(points.size(), 0);
  if (is_compact(points)) return flags;
  const FarBall ball = find_far_ball(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    flags[i] = is_finite(points[i]) && ball.is_far(points[i]) ? 1 : 0;
  }
  return flags;
}

std::vector<std::uint8_t> find_isolated_points(const PointTree& tree, std::span<const Vec3> points,
                                               const SamplingGaps& gaps, const Context& context,
                                               std::vector<std::uint32_t>* neighbors) {
  if (points.size() < kLeastGroup) {
    if (neighbors != nullptr) *neighbors = graph_neighbors(tree, gaps, context);
    return std::vector<std::uint8_t>(points.size(), 0);
  }
  return Groups(tree, points, gaps, context, neighbors).isolated();
}

}  // namespace rholm
