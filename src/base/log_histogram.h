// How positive values are distributed, within a hundredth of each. Layer: base.
#pragma once

#include <cmath>
#include <limits>
#include <map>

namespace rholm {

// Sums of weights of values between powers of 2^(1/64). Depends on the order in which they are
// added by no more than rounding of these sums.
class LogHistogram {
 public:
  void add(double value, double weight = 1) {
    const int bin = value > 0 ? static_cast<int>(std::floor(kBins * std::log2(value))) : kZero;
    bins_[bin] += weight;
    sum_ += weight;
  }
  // A value that this part of the weight does not exceed, and no smaller one but for the width of
  // its bin: the middle of it, 0 of values that are none, and without any.
  double quantile(double part) const {
    double below = 0;
    for (const auto& [bin, weight] : bins_) {
      below += weight;
      if (below > part * sum_) return value_of(bin);
    }
    return bins_.empty() ? 0 : value_of(bins_.rbegin()->first);
  }

 private:
  static constexpr double kBins = 64;  // to a factor of two
  static constexpr int kZero = std::numeric_limits<int>::min();
  static double value_of(int bin) { return bin == kZero ? 0 : std::exp2((bin + 0.5) / kBins); }

  std::map<int, double> bins_;
  double sum_ = 0;
};

}  // namespace rholm
