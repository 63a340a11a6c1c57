// Estimates a sum over many points by a closer look at a few of them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rholm {

struct ProportionalSample {
  std::vector<std::size_t> indices;  // ascending; an index may be repeated
  std::vector<double> stand_for;     // number of points that each index stands for
};
// Chooses `n` random points, each in proportion to its weight, which must be at least 0. Chooses
// none if the sum of the weights is 0 or not finite.
ProportionalSample proportional_sample(const std::vector<double>& weights, std::size_t n,
                                       std::uint64_t seed);

// Sum over all points to first order, and the correction that a sample adds.
struct CorrectedSum {
  double first = 0, added = 0, squares = 0;

  void add(double difference) {
    added += difference;
    squares += difference * difference;
  }
  double value() const { return std::max(first + added, 0.0); }
  // Returns the relative standard error of the root, from n terms.
  double error(std::size_t n) const {
    if (n == 0 || !(value() > 0)) return 0;
    const double variance = std::max(squares - added * added / static_cast<double>(n), 0.0);
    return std::sqrt(variance) / (2 * value());
  }
};

}  // namespace rholm
