// Finds the shifts with the most similar texture, three that close a
// triangle: first on a coarse grid of samples, then between its points.
#include "edit/texture/tile_lattice.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace rholm {
namespace {

// Lengths of the shifts, in radii of the disc. Shorter shifts show
// less of the texture; longer ones leave little overlap for seams.
constexpr double kShortest = 1.3, kLongest = 1.6;
// Cell corners, where three copies meet, lie this far inside the discs, to leave room for seams.
constexpr double kRoom = 0.06;
// Angle between a and b in degrees.
constexpr double kLeastAngle = 48, kLargestAngle = 72;
// Samples of the coarse search along a radius, and the number of later halvings of its step.
constexpr int kSamples = 32, kHalvings = 5;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Returns the radius of the circle through 0, a and b.
double corner_radius(const TileLattice& lattice) {
  const auto [a, b] = lattice;
  const double twice = std::abs(a.p * b.q - a.q * b.p);
  const double third = length(b - a);
  return twice > 0 ? length(a) * length(b) * third / (2 * twice) : kInfinity;
}

bool is_allowed(const TileLattice& lattice, double radius) {
  const auto [a, b] = lattice;
  for (const Place2& v : {a, b, b - a}) {
    if (length(v) < kShortest * radius || length(v) > kLongest * radius) return false;
  }
  const double angle =
      std::atan2(a.p * b.q - a.q * b.p, a.p * b.p + a.q * b.q) * 180 / std::numbers::pi;
  return angle >= kLeastAngle && angle <= kLargestAngle &&
         corner_radius(lattice) <= (1 - kRoom) * radius;
}

// Samples in the disc at distances of step().
class Overlaps {
 public:
  Overlaps(const DetailMap& map, double radius)
      : map_(map), radius_(radius), step_(radius / kSamples) {
    for (int j = -kSamples; j <= kSamples; ++j) {
      for (int i = -kSamples; i <= kSamples; ++i) {
        const Place2 at{i * step_, j * step_};
        values_.push_back(map(at));
        inside_.push_back(length(at) < radius ? 1 : 0);
      }
    }
  }
  double step() const { return step_; }

  // Returns the mean square difference of the texture and its shifted copy where they overlap.
  double apart(int di, int dj) const {
    double sum = 0, count = 0;
    for (int j = std::max(-kSamples, dj - kSamples); j <= std::min(kSamples, dj + kSamples); ++j) {
      for (int i = std::max(-kSamples, di - kSamples); i <= std::min(kSamples, di + kSamples);
           ++i) {
        const std::size_t here = index(i, j), there = index(i - di, j - dj);
        if ((inside_[here] & inside_[there]) == 0) continue;
        sum += (values_[here] - values_[there]) * (values_[here] - values_[there]);
        ++count;
      }
    }
    return count > 0 ? sum / count : kInfinity;
  }
  double apart(const Place2& shift) const {
    double sum = 0, count = 0;
    for (int j = -kSamples; j <= kSamples; ++j) {
      for (int i = -kSamples; i <= kSamples; ++i) {
        const Place2 there{i * step_ - shift.p, j * step_ - shift.q};
        const double square = there.p * there.p + there.q * there.q;
        if (inside_[index(i, j)] == 0 || !(square < radius_ * radius_)) continue;
        const double off = values_[index(i, j)] - map_(there);
        sum += off * off;
        ++count;
      }
    }
    return count > 0 ? sum / count : kInfinity;
  }
  double apart(const TileLattice& lattice) const {
    const auto [a, b] = lattice;
    return apart(a) + apart(b) + apart(b - a);
  }

 private:
  static std::size_t index(int i, int j) {
    return static_cast<std::size_t>((j + kSamples) * (2 * kSamples + 1) + i + kSamples);
  }
  const DetailMap& map_;
  double radius_, step_;
  std::vector<double> values_;
  std::vector<std::uint8_t> inside_;
};

constexpr int kMostSteps = static_cast<int>(kLongest * kSamples) + 1;

// Returns the differences of all shifts by whole steps; infinite for excluded lengths.
std::vector<double> all_shifts(const Overlaps& overlaps) {
  constexpr int kWidth = 2 * kMostSteps + 1;
  std::vector<double> apart(static_cast<std::size_t>(kWidth * kWidth), kInfinity);
  for (int j = 0; j <= kMostSteps; ++j) {
    for (int i = -kMostSteps; i <= kMostSteps; ++i) {
      const double steps = std::hypot(i, j);
      if (steps < kShortest * kSamples || steps > kLongest * kSamples) continue;
      const auto at = static_cast<std::size_t>((j + kMostSteps) * kWidth + i + kMostSteps);
      apart[at] = apart[apart.size() - 1 - at] = overlaps.apart(i, j);
    }
  }
  return apart;
}

TileLattice best_of_grid(const Overlaps& overlaps, double radius) {
  const std::vector<double> apart = all_shifts(overlaps);
  const auto of = [&](int i, int j) {
    if (std::max(std::abs(i), std::abs(j)) > kMostSteps) return kInfinity;
    return apart[static_cast<std::size_t>((j + kMostSteps) * (2 * kMostSteps + 1) + i +
                                          kMostSteps)];
  };
  // Starts with the regular lattice, unless another one is better.
  const double s = overlaps.step(), regular = 1.45 * radius;
  TileLattice best{{regular, 0}, {regular / 2, regular * std::sqrt(0.75)}};
  double least = overlaps.apart(best);
  for (int aj = 0; aj <= kMostSteps; ++aj) {
    for (int ai = 0; ai <= kMostSteps; ++ai) {
      // One of the six shortest shifts is within 60 degrees of the first axis.
      if (of(ai, aj) == kInfinity || aj >= std::sqrt(3.0) * ai) continue;
      // b is near a turned by 60 degrees.
      const int half_i = ai / 2, half_j = aj / 2;
      const int bi = static_cast<int>(half_i - aj * 0.866),
                bj = static_cast<int>(half_j + ai * 0.866);
      constexpr int kAround = kSamples / 3;
      for (int j = bj - kAround; j <= bj + kAround; ++j) {
        for (int i = bi - kAround; i <= bi + kAround; ++i) {
          const double sum = of(ai, aj) + of(i, j) + of(i - ai, j - aj);
          if (!(sum < least)) continue;
          const TileLattice lattice{{ai * s, aj * s}, {i * s, j * s}};
          if (!is_allowed(lattice, radius)) continue;
          least = sum;
          best = lattice;
        }
      }
    }
  }
  return best;
}

}  // namespace

TileLattice find_lattice(const DetailMap& map, double radius) {
  const Overlaps overlaps(map, radius);
  TileLattice best = best_of_grid(overlaps, radius);
  double least = overlaps.apart(best), step = overlaps.step();
  for (int halving = 0; halving < kHalvings; ++halving) {
    step /= 2;
    for (bool better = true; better;) {
      better = false;
      for (const Place2& by :
           {Place2{step, 0}, Place2{-step, 0}, Place2{0, step}, Place2{0, -step}}) {
        for (Place2 TileLattice::*const which : {&TileLattice::a, &TileLattice::b}) {
          TileLattice moved = best;
          moved.*which = moved.*which + by;
          if (!is_allowed(moved, radius)) continue;
          const double apart = overlaps.apart(moved);
          if (!(apart < least)) continue;
          least = apart, best = moved, better = true;
        }
      }
    }
  }
  return best;
}

}  // namespace rholm
