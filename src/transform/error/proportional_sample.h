// A sum over many points of which a few are looked at closely.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace rholm {

struct ProportionalSample {
  std::vector<std::size_t> indices;  // ascending, some more than once
  std::vector<double> stand_for;     // of each: so many points
};
// `n` points by chance, each in proportion to its weight, at least 0; none where the sum of the
// weights is 0 or not finite.
ProportionalSample proportional_sample(const std::vector<double>& weights, std::size_t n,
                                       std::uint64_t seed);

// A sum over all points to first order, and what a sample says is to be added.
struct CorrectedSum {
  double first = 0, added = 0, squares = 0;

  void add(double difference) {
    added += difference;
    squares += difference * difference;
  }
  double value() const { return std::max(first + added, 0.0); }
  // Relative standard error of the root, of n terms.
  double error(std::size_t n) const {
    if (n == 0 || !(value() > 0)) return 0;
    const double variance = std::max(squares - added * added / static_cast<double>(n), 0.0);
    return std::sqrt(variance) / (2 * value());
  }
};

}  // namespace rholm
