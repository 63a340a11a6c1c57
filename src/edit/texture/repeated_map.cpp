// A tile is a patch of the disc with six sides; its translates along the lattice
// fill the plane, so opposite sides are the same line. Each side is the path of
// least squared difference between two neighbours (the minimum error boundary
// cut of Efros, Freeman 2001). Sides end where three tiles differ least.
#include "edit/texture/repeated_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace rholm {
namespace {

// Tiles end this far inside the disc, which leaves room for the fade.
constexpr double kDisc = 0.95;
// Half width of the fade across a seam, in lengths over which the texture's height
// changes by its rms. Waves of length w have the length w / 4.4. Chosen by looking.
constexpr double kFade = 1.2, kWidestFade = 0.05;
// Region around the middle where three tiles may meet, as a part of the disc.
constexpr double kCornerReach = 0.12;
constexpr int kCornerSteps = 12;
// Steps along a seam, and its largest deviation from the straight line, in its length.
constexpr int kAlong = 96;
constexpr double kAside = 0.45;
constexpr int kMostSamples = 512;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Returns the cost of a seam at x between the tiles at 0 and t; infinite beyond either tile.
double difference(const DetailMap& map, const Place2& x, const Place2& t) {
  if (!(length(x) < kDisc) || !(length(x - t) < kDisc)) return kInfinity;
  const double off = map(x) - map(x - t);
  return off * off;
}

// Returns the centre of the circle through 0, a and b.
Place2 middle_of(const Place2& a, const Place2& b) {
  const double twice = 2 * (a.p * b.q - a.q * b.p);
  const double aa = a.p * a.p + a.q * a.q, bb = b.p * b.p + b.q * b.q;
  return {(b.q * aa - a.q * bb) / twice, (a.p * bb - b.p * aa) / twice};
}

// Returns the point near the centre where the tiles at 0, a and b differ least.
Place2 corner_of(const DetailMap& map, const Place2& a, const Place2& b) {
  const Place2 middle = middle_of(a, b);
  Place2 best = middle;
  double least = kInfinity;
  for (int j = -kCornerSteps; j <= kCornerSteps; ++j) {
    for (int i = -kCornerSteps; i <= kCornerSteps; ++i) {
      const Place2 x = middle + (kCornerReach / kCornerSteps) * Place2{1.0 * i, 1.0 * j};
      const double cost =
          difference(map, x, a) + difference(map, x, b) + difference(map, x - a, b - a);
      if (cost < least) least = cost, best = x;
    }
  }
  return best;
}

// Returns the path between two corners with the least difference between the tiles
// at 0 and t. It deviates by at most 45 degrees, so that paths from one corner
// stay apart. The straight path lies within both discs, because discs are convex.
std::vector<Place2> seam(const DetailMap& map, const Place2& from, const Place2& to,
                         const Place2& t) {
  const Place2 along = (1.0 / kAlong) * (to - from);
  // Two steps aside have the length of one step along.
  const Place2 aside{-along.q / 2, along.p / 2};
  constexpr int kReach = static_cast<int>(2 * kAside * kAlong);
  constexpr auto kWidth = static_cast<std::size_t>(2 * kReach + 1);
  std::vector<double> cost(kWidth, kInfinity), next(kWidth);
  std::vector<std::int8_t> came((kAlong + 1) * kWidth, 0);
  cost[kReach] = 0;
  for (int i = 1; i <= kAlong; ++i) {
    for (int k = -kReach; k <= kReach; ++k) {
      const auto at = static_cast<std::size_t>(k + kReach);
      next[at] = kInfinity;
      if (std::abs(k) > 2 * std::min(i, kAlong - i)) continue;
      for (const int move : {0, -1, 1, -2, 2}) {
        if (std::abs(k - move) > kReach) continue;
        const double before = cost[static_cast<std::size_t>(k - move + kReach)];
        if (before < next[at]) {
          next[at] = before;
          came[static_cast<std::size_t>(i) * kWidth + at] = static_cast<std::int8_t>(move);
        }
      }
      if (next[at] < kInfinity && i < kAlong) {
        next[at] += difference(map, from + 1.0 * i * along + 1.0 * k * aside, t);
      }
    }
    std::swap(cost, next);
  }
  std::vector<Place2> path;
  for (int i = kAlong, k = 0; i >= 0; --i) {
    path.push_back(from + 1.0 * i * along + 1.0 * k * aside);
    k -= came[static_cast<std::size_t>(i) * kWidth + static_cast<std::size_t>(k + kReach)];
  }
  std::reverse(path.begin(), path.end());
  return path;
}

// Returns the tile's outline, counter-clockwise: its sides towards a,
// b and b - a, then the same sides shifted to the opposite neighbours.
std::vector<Place2> outline_of(const DetailMap& map, const TileLattice& lattice) {
  const auto [a, b] = lattice;
  const Place2 c = b - a;
  const Place2 ab = corner_of(map, a, b), bc = corner_of(map, b, c);
  const std::array<std::vector<Place2>, 3> sides = {seam(map, bc - c, ab, a), seam(map, ab, bc, b),
                                                    seam(map, bc, ab - a, c)};
  const std::array<Place2, 3> shifts = {a, b, c};
  std::vector<Place2> outline;
  for (const auto& side : sides) outline.insert(outline.end(), side.begin(), side.end());
  for (std::size_t k = 0; k < 3; ++k) {
    for (auto at = sides[k].rbegin(); at != sides[k].rend(); ++at) {
      outline.push_back(*at - shifts[k]);
    }
  }
  return outline;
}

// Square of samples of the plane around the origin, at (i a + j b) / n, |i|, |j| <= reach.
struct Plane {
  int n = 0, reach = 0;
  std::vector<double> values;
  int width() const { return 2 * reach + 1; }
  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j + reach) * static_cast<std::size_t>(width()) +
           static_cast<std::size_t>(i + reach);
  }
};

// Sets samples inside the outline to 1, line by line between its crossings.
void fill(const std::vector<Place2>& outline, const TileLattice& lattice, Plane& plane) {
  const auto [a, b] = lattice;
  const double area = a.p * b.q - a.q * b.p;
  std::vector<Place2> corners;
  corners.reserve(outline.size());
  for (const Place2& x : outline) {
    corners.push_back((plane.n / area) * Place2{x.p * b.q - x.q * b.p, a.p * x.q - a.q * x.p});
  }
  std::vector<double> crossings;
  for (int j = -plane.reach; j <= plane.reach; ++j) {
    crossings.clear();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Place2 &from = corners[k], &to = corners[(k + 1) % corners.size()];
      if ((from.q <= j) == (to.q <= j)) continue;
      crossings.push_back(from.p + (to.p - from.p) * (j - from.q) / (to.q - from.q));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
      const int first = std::max(-plane.reach, static_cast<int>(std::ceil(crossings[k])));
      for (int i = first; i <= plane.reach && i < crossings[k + 1]; ++i) {
        plane.values[plane.index(i, j)] = 1;
      }
    }
  }
}

// Sums 2 half + 1 samples along (di, dj), updated from the previous sum; the
// sums are whole numbers, so exact. Samples near the border and beyond it are 0.
void box(int di, int dj, int half, Plane& plane) {
  const std::vector<double> before = plane.values;
  const auto of = [&](const std::vector<double>& values, int i, int j) {
    return std::max(std::abs(i), std::abs(j)) > plane.reach ? 0 : values[plane.index(i, j)];
  };
  for (int j = -plane.reach; j <= plane.reach; ++j) {
    for (int i = -plane.reach; i <= plane.reach; ++i) {
      plane.values[plane.index(i, j)] = of(plane.values, i - di, j - dj) +
                                        of(before, i + half * di, j + half * dj) -
                                        of(before, i - (half + 1) * di, j - (half + 1) * dj);
    }
  }
}

// Returns the rms of the heights in the disc over the rms of their slopes.
double length_of_change(const DetailMap& map) {
  double heights = 0, slopes = 0;
  for (double q = -kDisc; q < kDisc; q += map.step) {
    for (double p = -kDisc; p < kDisc; p += map.step) {
      if (!(std::hypot(p, q) < kDisc)) continue;
      const double h = map({p, q}), dp = map({p + map.step, q}) - h;
      const double dq = map({p, q + map.step}) - h;
      heights += h * h;
      slopes += (dp * dp + dq * dq) / (map.step * map.step);
    }
  }
  return slopes > 0 ? std::sqrt(heights / slopes) : 0;
}

// Returns the blend weight of the tile at 0 with a faded outline. Boxes along
// the three directions of the lattice, applied twice, are round enough.
Plane blend_weights_of(const std::vector<Place2>& outline, const TileLattice& lattice, int n,
                       double fade) {
  Plane plane;
  plane.n = n;
  plane.reach = n + n / 4;  // tiles reach 1.04, the fade 0.05 beyond
  plane.values.assign(static_cast<std::size_t>(plane.width() * plane.width()), 0);
  fill(outline, lattice, plane);
  // Six boxes reach 4 half-widths along each axis.
  const int half = std::max(1, static_cast<int>(std::lround(fade * n / length(lattice.a) / 4)));
  for (int twice = 0; twice < 2; ++twice) {
    box(1, 0, half, plane);
    box(0, 1, half, plane);
    box(-1, 1, half, plane);
  }
  return plane;
}

// Returns the weights of four neighbours.
std::array<double, 4> cubic(double t) {
  const double u = 1 - t;
  return {-0.5 * t * u * u, 1 + t * t * (1.5 * t - 2.5), 1 + u * u * (1.5 * u - 2.5),
          -0.5 * u * t * t};
}

}  // namespace

double RepeatedMap::operator()(const Place2& at) const {
  const auto [a, b] = lattice;
  const double area = a.p * b.q - a.q * b.p;
  const double u = (at.p * b.q - at.q * b.p) / area, v = (a.p * at.q - a.q * at.p) / area;
  const double x = (u - std::floor(u)) * n, y = (v - std::floor(v)) * n;
  if (!(x <= n) || !(y <= n)) return 0;
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const std::array<double, 4> of_i = cubic(x - i), of_j = cubic(y - j);
  double sum = 0;
  for (int l = 0; l < 4; ++l) {
    const double* const line = &values[static_cast<std::size_t>((j + l - 1 + n) % n * n)];
    for (int k = 0; k < 4; ++k) {
      sum += of_j[static_cast<std::size_t>(l)] * of_i[static_cast<std::size_t>(k)] *
             line[(i + k - 1 + n) % n];
    }
  }
  return sum;
}

RepeatedMap repeat(const DetailMap& map) {
  RepeatedMap repeated;
  repeated.lattice = find_lattice(map, kDisc);
  const auto [a, b] = repeated.lattice;
  const double wanted = std::max(length(a), length(b)) / map.step;
  const int n = static_cast<int>(std::clamp(std::ceil(wanted), 16.0, 1.0 * kMostSamples));
  repeated.n = n;
  const double fade = std::min(kWidestFade, kFade * length_of_change(map));
  const Plane weights =
      blend_weights_of(outline_of(map, repeated.lattice), repeated.lattice, n, fade);
  repeated.values.assign(static_cast<std::size_t>(n * n), 0);
  std::vector<double> weight_sums(repeated.values.size(), 0);
  for (int j = -weights.reach; j <= weights.reach; ++j) {
    for (int i = -weights.reach; i <= weights.reach; ++i) {
      const double weight = weights.values[weights.index(i, j)];
      if (!(weight > 0)) continue;
      const auto at = static_cast<std::size_t>((j + 2 * n) % n * n + (i + 2 * n) % n);
      repeated.values[at] += weight * map((1.0 * i / n) * a + (1.0 * j / n) * b);
      weight_sums[at] += weight;
    }
  }
  for (std::size_t i = 0; i < weight_sums.size(); ++i) {
    if (weight_sums[i] > 0) repeated.values[i] /= weight_sums[i];
  }
  return repeated;
}

}  // namespace rholm
