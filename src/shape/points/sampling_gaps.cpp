#include "shape/points/sampling_gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "shape/points/plane_fit.h"
#include "shape/points/symmetric.h"

namespace rholm {
namespace {

constexpr std::size_t kFirst =
    24;  // neighbours among which gaps are sought at first, then twice as many
constexpr std::size_t kMost = 384;
// Number of points over which gaps are averaged, and number of those with smaller gaps that count.
constexpr std::size_t kAround = 24, kCounted = 12;
constexpr std::size_t kSeeds = 64;
constexpr std::size_t kGrain = 512;
// Ratios of random points are 1.2 ... 1.5 at nine of ten places (bodies of scripts/scan-figures,
// 1000 to 100 000 points). Rows at twice their steps have 2.
constexpr double kEven = 1.8;
constexpr double kShareInRows = 0.1;
// Ratios of lengths of random points on the same bodies are 1.2 ... 2.1, and above 3 once in 100
// 000 times. From this ratio on, the points lie in rows.
constexpr double kSurelyRows = 3;
// A point at r hides a point at q if r . q > between r . r. With 1 (Gabriel), a point of the own
// row just hides the next row where rows bend sideways. With more, a row that bends along itself,
// at an edge, seems to surround its points; along a straight row the limit is 2. Both errors make
// the ratio too small, so the larger ratio is taken.
constexpr std::array<double, 2> kBetween = {1, 1.2};
// Directions to neighbours that leave a wider gap than this belong to one row. Radians.
constexpr double kOneSided = 2.6;

void add(Symmetric3& sum, const Vec3& d) {
  sum.xx += d.x * d.x, sum.yy += d.y * d.y, sum.zz += d.z * d.z;
  sum.xy += d.x * d.y, sum.xz += d.x * d.z, sum.yz += d.y * d.z;
}

struct Scratch {
  std::vector<Neighbor> found;
  std::vector<Vec3> offsets;
  std::vector<Vec3> gaps;
  std::vector<Vec3> directions;
  std::vector<double> weights;
  std::vector<double> angles;
};

// Returns true if the gaps surround the point in the plane they span.
bool surround(Scratch& scratch) {
  if (scratch.gaps.size() < 3) return false;
  scratch.directions.clear();
  for (const Vec3& gap : scratch.gaps) scratch.directions.push_back(normalized(gap));
  scratch.directions.push_back({});
  scratch.weights.assign(scratch.directions.size(), 1.0);
  const Vec3 normal = fit_plane(scratch.directions, scratch.weights).normal;
  const Vec3 u = perpendicular(normal), v = cross(normal, u);
  scratch.angles.clear();
  for (const Vec3& gap : scratch.gaps)
    scratch.angles.push_back(std::atan2(dot(gap, v), dot(gap, u)));
  std::sort(scratch.angles.begin(), scratch.angles.end());
  double widest = scratch.angles.front() + 2 * std::numbers::pi - scratch.angles.back();
  for (std::size_t i = 1; i < scratch.angles.size(); ++i) {
    widest = std::max(widest, scratch.angles[i] - scratch.angles[i - 1]);
  }
  return widest < kOneSided;
}

// Gaps of one point: sums of products, and whether the gaps surround it. Gaps at an edge point
// across to another sheet and are less reliable. In a row, along2 is the mean square of the two
// nearest gaps, which are steps along the row, and across2 of the others; 0 if there are no others.
struct GapsOfPoint {
  Symmetric3 sum;
  bool surround = false;
  double along2 = 0, across2 = 0;
};
using BothGaps = std::array<GapsOfPoint, kBetween.size()>;

// Finds the gaps among the neighbours, nearest first, because only a nearer point can hide another.
void take_gaps(double between, Scratch& scratch) {
  scratch.gaps.clear();
  for (std::size_t j = 0; j < scratch.offsets.size(); ++j) {
    const Vec3& q = scratch.offsets[j];
    const auto nearer = scratch.offsets.begin() + static_cast<std::ptrdiff_t>(j);
    const bool free = std::none_of(scratch.offsets.begin(), nearer,
                                   [&](const Vec3& r) { return between * dot(r, r) < dot(r, q); });
    if (free) scratch.gaps.push_back(q);
  }
}

void add_up(std::span<const Vec3> gaps, GapsOfPoint& own) {
  for (const Vec3& gap : gaps) add(own.sum, gap);
  if (gaps.size() <= 2) return;
  own.along2 = (dot(gaps[0], gaps[0]) + dot(gaps[1], gaps[1])) / 2;
  own.across2 = eigenvalues(own.sum).largest / static_cast<double>(gaps.size() - 2);
}

// Finds the gaps for each of kBetween, with more neighbours until they surround the point.
BothGaps gaps_of(const PointTree& tree, std::span<const Vec3> points, std::span<const Vec3> normals,
                 std::size_t i, Scratch& scratch) {
  BothGaps result;
  for (std::size_t k = kFirst;; k *= 2) {
    tree.nearest_to(i, k + 1, scratch.found);
    scratch.offsets.clear();
    for (const Neighbor& near : scratch.found) {
      if (near.index == i) continue;
      if (!normals.empty() && dot(normals[near.index], normals[i]) < kOtherSheet) continue;
      scratch.offsets.push_back(points[near.index] - points[i]);
    }
    const bool last = k >= kMost || scratch.found.size() <= k;
    bool all = true;
    for (std::size_t b = 0; b < kBetween.size(); ++b) {
      GapsOfPoint& own = result[b];
      if (own.surround) continue;
      take_gaps(kBetween[b], scratch);
      own.surround = surround(scratch);
      all = all && own.surround;
      if (!own.surround && !last) continue;
      add_up(scratch.gaps, own);
    }
    if (all || last) return result;
  }
}

double trace(const Symmetric3& m) { return m.xx + m.yy + m.zz; }

double ratio_of(std::vector<GapsOfPoint>& around) {
  std::sort(around.begin(), around.end(), [](const GapsOfPoint& a, const GapsOfPoint& b) {
    return a.surround != b.surround ? a.surround : trace(a.sum) < trace(b.sum);
  });
  Symmetric3 sum;
  for (std::size_t j = 0; j < std::min(kCounted, around.size()); ++j) {
    const Symmetric3& own = around[j].sum;
    sum.xx += own.xx, sum.yy += own.yy, sum.zz += own.zz;
    sum.xy += own.xy, sum.xz += own.xz, sum.yz += own.yz;
  }
  const Eigenvalues values = eigenvalues(sum);
  if (!(values.middle > 0)) return kMostGapRatio;
  return std::clamp(std::sqrt(values.largest / values.middle), 1.0, kMostGapRatio);
}

// Compares lengths regardless of directions. Rows that turn from point to point, such as rings
// around a pole, have no common direction, and their ratio by directions seems small. Returns 1 if
// there may be no rows. Only the smaller half counts, as in ratio_of().
double ratio_of_lengths(std::span<const GapsOfPoint> around) {
  std::vector<double> along, across;
  for (const GapsOfPoint& own : around) {
    if (own.across2 > 0) along.push_back(own.along2), across.push_back(own.across2);
  }
  if (along.empty()) return 1;
  std::sort(along.begin(), along.end());
  std::sort(across.begin(), across.end());
  const std::size_t counted = (across.size() + 1) / 2;
  double sum = 0;
  for (std::size_t j = 0; j < counted; ++j) sum += across[j];
  const double along2 = along[along.size() / 2] * static_cast<double>(counted);
  if (!(sum > kSurelyRows * kSurelyRows * along2)) return 1;
  return std::min(std::sqrt(sum / along2), kMostGapRatio);
}

double larger_ratio(std::span<const BothGaps> around, RowsThatTurn turning) {
  double ratio = 1;
  for (std::size_t b = 0; b < kBetween.size(); ++b) {
    std::vector<GapsOfPoint> some;
    some.reserve(around.size());
    for (const BothGaps& both : around) some.push_back(both[b]);
    if (turning == RowsThatTurn::kCount) ratio = std::max(ratio, ratio_of_lengths(some));
    ratio = std::max(ratio, ratio_of(some));
  }
  return ratio;
}

}  // namespace

std::vector<double> gap_ratios(const PointTree& tree, std::span<const Vec3> points,
                               std::span<const Vec3> normals, std::size_t n_seeds,
                               const Context& context) {
  const std::size_t n = points.size();
  n_seeds = std::min(n, n_seeds);
  std::vector<double> ratios(n_seeds, 1.0);
  parallel_for(n_seeds, 32, context, {}, [&](std::size_t begin, std::size_t end) {
    Scratch scratch;
    std::vector<Neighbor> around;
    std::vector<BothGaps> all;
    for (std::size_t s = begin; s < end; ++s) {
      tree.nearest_to(s * n / n_seeds, kAround, around);
      all.clear();
      for (const Neighbor& near : around) {
        all.push_back(gaps_of(tree, points, normals, near.index, scratch));
      }
      ratios[s] = larger_ratio(all, RowsThatTurn::kIgnore);
    }
  });
  return ratios;
}

double spacing_around(const PointTree& tree, const SamplingGaps& gaps, const Vec3& place,
                      std::vector<Neighbor>& near) {
  // The radius of 24 random points around a place varies by a tenth, the radius of 8 by a fifth.
  constexpr std::size_t kCircles = 3;
  tree.nearest(place, 1, near);
  tree.nearest(place, kCircles * gaps.scaled(near.front().index, kCircle), near);
  return spacing_of_circle(near.back().distance2 / kCircles);
}

std::size_t SamplingGaps::typical_stride() const {
  if (ratio.empty()) return 1;
  std::vector<float> sorted = ratio;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return static_cast<std::size_t>(*middle + 0.5f);
}

SamplingGaps find_gaps(const PointTree& tree, std::span<const Vec3> points,
                       std::span<const Vec3> normals, const Context& context,
                       RowsThatTurn turning) {
  SamplingGaps gaps;
  std::vector<double> some = gap_ratios(tree, points, normals, kSeeds, context);
  const auto place = some.begin() + static_cast<std::ptrdiff_t>(
                                        (1 - kShareInRows) * static_cast<double>(some.size() - 1));
  std::nth_element(some.begin(), place, some.end());
  if (*place <= kEven) return gaps;
  const std::size_t n = points.size();
  std::vector<BothGaps> own(n);
  parallel_for(n, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    Scratch scratch;
    for (std::size_t i = begin; i < end; ++i) own[i] = gaps_of(tree, points, normals, i, scratch);
  });
  gaps.ratio.assign(n, 1.0f);
  parallel_for(n, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> around;
    std::vector<BothGaps> all;
    for (std::size_t i = begin; i < end; ++i) {
      tree.nearest_to(i, kAround, around);
      all.clear();
      for (const Neighbor& near : around) all.push_back(own[near.index]);
      gaps.ratio[i] = static_cast<float>(larger_ratio(all, turning));
    }
  });
  return gaps;
}

}  // namespace rholm
