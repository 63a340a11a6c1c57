// Sum that keeps the rounding error of each addition, found as by Knuth, without branches. Its
// error is about n 2^-106 of the sum of moduli and one rounding of the result, instead of n 2^-53.
#pragma once

namespace rholm {

class CompensatedSum {
 public:
  void add(double x) {
    const double t = sum_ + x;
    const double added = t - sum_;
    correction_ += (sum_ - (t - added)) + (x - added);
    sum_ = t;
  }
  double value() const { return sum_ + correction_; }

 private:
  double sum_ = 0;
  double correction_ = 0;
};

}  // namespace rholm
