// A sum that keeps its rounding error (Neumaier 1974): relative error about 2^-53 of the sum of
// moduli times n 2^-53, instead of n 2^-53.
#pragma once

#include <cmath>

namespace rholm {

class CompensatedSum {
 public:
  void add(double x) {
    const double t = sum_ + x;
    correction_ += std::abs(sum_) >= std::abs(x) ? (sum_ - t) + x : (x - t) + sum_;
    sum_ = t;
  }
  double value() const { return sum_ + correction_; }

 private:
  double sum_ = 0;
  double correction_ = 0;
};

}  // namespace rholm
