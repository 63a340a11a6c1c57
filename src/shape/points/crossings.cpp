#include "shape/points/crossings.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "shape/points/normals.h"
#include "shape/points/plane_fit.h"
#include "shape/points/point_rank.h"
#include "shape/points/symmetric.h"

namespace rholm {
namespace {

// All lengths are in radii of the neighbourhood, unless stated otherwise.

// Number of points looked at, over the square root of the number of all points. Chosen: 4 of them
// are near the shortest crossing that is refused.
constexpr double kSeeds = 10;
// Largest radius of a local ball, relative to the diagonal, as in local_shape.cpp.
constexpr double kLocal = 0.2;
// In standard deviations of noise: distance of 99 % of the points from their sheet, to either side,
// and radius of a ball. Sheets crossing at 42 degrees and more are then separated (kApart).
constexpr double kNoise = 2.5, kReach = 14;
// Largest distance of a point from its sheet, and from the planes with which sheets
// are first sought (chosen).
constexpr double kTolerance = 0.1, kFirstTolerance = 0.15;
// Number of random triples of points tried for a plane. At least one triple in four is from the
// larger of two sheets, so 48 triples fail once in a million times.
constexpr std::size_t kTriples = 48;
constexpr int kRounds = 4;              // number of fits of both sheets (chosen)
constexpr std::size_t kFewest = 8;      // points of a sheet, which has six coefficients
constexpr double kFlatter = 1e-3;       // of the weight of a point: pulls curvatures to zero
constexpr std::size_t kMostTaken = 96;  // largest number of points of a ball that are compared
// Least share of points that lie on a sheet (chosen). Real shapes of 2000 to 8000 points, with
// walls nearer than points, have crossings of up to 0.17 diagonals with 0.95, of 0.07 with 0.98.
constexpr double kExplained = 0.98;
constexpr double kHalf = 0.1;             // least share of points on each half of each sheet
constexpr double kLeastAngle = 0.258819;  // sine of half of 30 degrees (chosen)
// At a distance r from their line, sheets are 2 r sin(angle / 2) apart. At half of the radius, this
// is at least the sum of both tolerances.
constexpr double kApart = 2;
// Largest height of a sheet at the rim over its plane. With a larger limit, the two walls of a thin
// plate and its rim count as one sheet, and noise between them as the other
// (tests/cli/clouds_test.py --crossings).
constexpr double kBend = 0.4;
// Least ratio of the standard deviations along the third and the second principal axis: half the
// ratio 0.27 of two halves that meet at 30 degrees.
constexpr double kFlat = 0.15;
// Largest distance from the line of a point that is recognised. Two planes cross at a right angle,
// and a ball is around a point of one plane at a distance t from the line. The smaller half of the
// other sheet has the share (acos(t) - t sqrt(1 - t^2)) / (2 pi - pi t^2) of the points. This is
// kHalf at t = 0.54; points within kTolerance of the other sheet reduce t.
constexpr double kBand = 0.47;

struct Sheet {
  Vec3 u, v, normal;
  Vector6 c{};  // coefficients of 1, x, y, x^2, x y, y^2

  static Sheet across(const Vec3& normal, double offset) {
    Sheet sheet{.u = perpendicular(normal), .v = {}, .normal = normal};
    sheet.v = cross(normal, sheet.u);
    sheet.c[0] = offset;
    return sheet;
  }
  double height(const Vec3& p) const {
    const double x = dot(p, u), y = dot(p, v);
    const double z =
        dot(p, normal) - (c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y);
    return z / std::sqrt(1 + c[1] * c[1] + c[2] * c[2]);
  }
  Vec3 direction() const { return normalized(normal - c[1] * u - c[2] * v); }
  double bend() const {
    return std::abs(c[3] + c[5]) / 2 + std::hypot((c[3] - c[5]) / 2, c[4] / 2);
  }
};

// Finds the plane through three points that most points are near to; false if none has enough.
bool find_plane(std::span<const Vec3> points, double tolerance, std::uint64_t seed, Sheet& sheet) {
  std::size_t most = kFewest - 1;
  Vec3 best;
  double offset = 0;
  for (std::size_t t = 0; t < kTriples; ++t) {
    const auto pick = [&](std::size_t j) {
      return points[random_bits(seed, 3 * t + j) % points.size()];
    };
    const Vec3 a = pick(0), b = pick(1), c = pick(2);
    const Vec3 normal = normalized(cross(b - a, c - a));
    const double at = dot(normal, a);
    std::size_t n = 0;
    for (const Vec3& p : points) n += std::abs(dot(normal, p) - at) < tolerance ? 1 : 0;
    if (n > most && normal != Vec3{}) most = n, best = normal, offset = at;
  }
  if (most < kFewest) return false;
  sheet = Sheet::across(best, offset);
  return true;
}

// Fits the paraboloid to the points with of[i] == whose; false if they do not determine one.
bool fit(std::span<const Vec3> points, std::span<const std::uint8_t> of, std::uint8_t whose,
         Sheet& sheet) {
  sheet = Sheet::across(sheet.direction(), 0);
  Matrix6 a{};
  std::size_t n = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (of[i] != whose) continue;
    const double x = dot(points[i], sheet.u), y = dot(points[i], sheet.v);
    const double z = dot(points[i], sheet.normal);
    const double terms[kSix] = {1, x, y, x * x, x * y, y * y};
    for (int j = 0; j < kSix; ++j) {
      for (int k = 0; k <= j; ++k) a[j][k] += terms[j] * terms[k];
      sheet.c[j] += terms[j] * z;
    }
    ++n;
  }
  for (int j = 3; j < kSix; ++j) a[j][j] += kFlatter * static_cast<double>(n);
  if (n < kFewest || !factorize(a)) return false;
  solve(a, sheet.c);
  return true;
}

// Finds two sheets for the points around a point; returns false if there are none.
bool find_sheets(std::span<const Vec3> points, double tolerance, std::array<Sheet, 2>& sheets) {
  const double first = std::max(kFirstTolerance, tolerance);
  if (!find_plane(points, first, 0, sheets[0])) return false;
  std::vector<Vec3> others(points.begin(), points.end());
  std::erase_if(others, [&](const Vec3& p) { return std::abs(sheets[0].height(p)) < first; });
  if (others.size() < kFewest || !find_plane(others, first, 1, sheets[1])) return false;
  std::vector<std::uint8_t> of(points.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double a = std::abs(sheets[0].height(points[i]));
      const double b = std::abs(sheets[1].height(points[i]));
      const bool unclear = std::min(a, b) > 2 * first || std::max(a, b) < tolerance;
      of[i] = unclear ? 2 : a < b ? 0 : 1;
    }
    if (!fit(points, of, 0, sheets[0]) || !fit(points, of, 1, sheets[1])) return false;
  }
  return true;
}

bool have_crossing(std::span<const Vec3> points, double tolerance) {
  std::array<Sheet, 2> sheets;
  if (!find_sheets(points, tolerance, sheets)) return false;
  if (std::max(sheets[0].bend(), sheets[1].bend()) > kBend) return false;
  const double cosine = std::abs(dot(sheets[0].direction(), sheets[1].direction()));
  const double half_sine = std::sqrt(std::max(0.0, (1 - cosine) / 2));
  if (half_sine < std::max(kLeastAngle, kApart * tolerance)) return false;
  std::size_t explained = 0;
  std::array<std::size_t, 4> halves{};
  for (const Vec3& p : points) {
    const double a = sheets[0].height(p), b = sheets[1].height(p);
    const bool on_a = std::abs(a) < tolerance, on_b = std::abs(b) < tolerance;
    explained += on_a || on_b ? 1 : 0;
    if (on_a && !on_b) ++halves[b > 0 ? 0 : 1];
    if (on_b && !on_a) ++halves[a > 0 ? 2 : 3];
  }
  const auto n = static_cast<double>(points.size());
  const auto least = static_cast<double>(*std::min_element(halves.begin(), halves.end()));
  return static_cast<double>(explained) >= kExplained * n && least >= kHalf * n;
}

// The points around a point, relative to it.
struct Surroundings {
  Neighborhood near;
  std::vector<Neighbor> within;
  std::vector<double> weights;
  double n = 0;  // number of points, of which some are taken

  void gather(const PointTree& tree, std::span<const Vec3> points, std::uint32_t i,
              std::size_t stride, double reach) {
    near.gather(tree, points, i, kCrossingNeighbors, stride);
    n = static_cast<double>(near.points.size() * stride);
    if (near.radius < reach) gather_ball(tree, points, i, reach);
    weights.assign(near.points.size(), 1.0);
  }
  bool are_flat() const {
    const PlaneFit plane = fit_plane(near.points, weights);
    if (!(plane.length > 0)) return true;
    const double second = (plane.width - plane.height) / (1 + plane.height / plane.length);
    return !(plane.height >= kFlat * kFlat * second) || !(second > 0);
  }

 private:
  // Takes some points of a ball, evenly spread over their distances.
  void gather_ball(const PointTree& tree, std::span<const Vec3> points, std::uint32_t i,
                   double reach) {
    tree.within(points[i], reach, within);
    std::sort(within.begin(), within.end(), [](const Neighbor& a, const Neighbor& b) {
      return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.index < b.index;
    });
    const std::size_t all = within.size(), taken = std::min(all, kMostTaken);
    near.points.resize(taken);
    for (std::size_t j = 0; j < taken; ++j) {
      near.points[j] = (points[within[j * all / taken].index] - points[i]) / reach;
    }
    near.radius = reach;
    n = static_cast<double>(all);
  }
};

struct Seed {
  std::uint32_t point = 0;
  std::uint64_t rank = 0;
  double length = 0;  // length of crossing that the seed stands for
};

}  // namespace

double CrossingSearch::reach() const { return is_local() ? kReach * noise : 0; }

bool CrossingSearch::is_local() const { return kReach * noise <= kLocal * diagonal; }

std::size_t Crossings::named() const { return std::min<std::size_t>(found, kNamedCrossings); }

void Crossings::add(const Crossings& other) {
  std::vector<std::pair<std::uint64_t, Vec3>> both;
  both.reserve(2 * kNamedCrossings);
  for (std::size_t k = 0; k < named(); ++k) both.emplace_back(rank[k], at[k]);
  for (std::size_t k = 0; k < other.named(); ++k) both.emplace_back(other.rank[k], other.at[k]);
  std::stable_sort(both.begin(), both.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  for (std::size_t k = 0; k < std::min(both.size(), kNamedCrossings); ++k) {
    std::tie(rank[k], at[k]) = both[k];
  }
  length += other.length, found += other.found;
}

Crossings find_crossings(const PointTree& tree, std::span<const Vec3> points,
                         const SamplingGaps& gaps, std::span<const std::uint8_t> foreign,
                         const CrossingSearch& search, const Context& context) {
  Crossings result;
  if (!search.is_local() || search.n < 2 * kCrossingNeighbors) return result;
  const double share = std::min(1.0, kSeeds / std::sqrt(static_cast<double>(search.n)));
  std::vector<Seed> seeds;
  seeds.reserve(static_cast<std::size_t>(2 * share * static_cast<double>(points.size())));
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (!foreign.empty() && foreign[i] != 0) continue;
    const std::uint64_t rank = rank_of(points[i]);
    if (is_chosen(rank, share)) seeds.push_back({i, rank});
  }
  parallel_for(seeds.size(), 64, context, {}, [&](std::size_t begin, std::size_t end) {
    Surroundings around;
    for (std::size_t s = begin; s < end; ++s) {
      const std::uint32_t i = seeds[s].point;
      around.gather(tree, points, i, gaps.stride(i), search.reach());
      const double radius = around.near.radius;
      if (!(radius > 0) || radius > kLocal * search.diagonal || around.are_flat()) continue;
      const double tolerance = std::max(kTolerance, kNoise * search.noise / radius);
      if (!have_crossing(around.near.points, tolerance)) continue;
      // The ball has n points on two discs of area pi radius^2. On both sheets, points within kBand
      // radii of the line, on both sides, find the crossing.
      seeds[s].length = 2 * std::numbers::pi * radius / (4 * kBand * around.n * share);
    }
  });
  std::erase_if(seeds, [](const Seed& seed) { return seed.length == 0; });
  std::sort(seeds.begin(), seeds.end(),
            [](const Seed& a, const Seed& b) { return a.rank < b.rank; });
  result.found = seeds.size();
  for (const Seed& seed : seeds) result.length += seed.length;
  for (std::size_t k = 0; k < result.named(); ++k) {
    result.at[k] = points[seeds[k].point], result.rank[k] = seeds[k].rank;
  }
  return result;
}

}  // namespace rholm
