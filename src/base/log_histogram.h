// Distribution of positive values, each within a hundredth of itself. Layer: base.
#pragma once

#include <cmath>
#include <limits>
#include <map>

namespace rholm {

// Sums the weights of values between consecutive powers of 2^(1/64). The order of the additions
// changes these sums only by rounding.
class LogHistogram {
 public:
  void add(double value, double weight = 1) {
    const int bin = value > 0 ? static_cast<int>(std::floor(kBins * std::log2(value))) : kZero;
    bins_[bin] += weight;
    sum_ += weight;
  }
  // Returns the middle of the lowest bin up to which more than this part of the weight lies.
  // Returns 0 for the bin of values that are not positive, and for an empty histogram.
  double quantile(double part) const {
    double below = 0;
    for (const auto& [bin, weight] : bins_) {
      below += weight;
      if (below > part * sum_) return value_of(bin);
    }
    return bins_.empty() ? 0 : value_of(bins_.rbegin()->first);
  }

 private:
  static constexpr double kBins = 64;  // bins per factor of two
  static constexpr int kZero = std::numeric_limits<int>::min();
  static double value_of(int bin) { return bin == kZero ? 0 : std::exp2((bin + 0.5) / kBins); }

  std::map<int, double> bins_;
  double sum_ = 0;
};

}  // namespace rholm
