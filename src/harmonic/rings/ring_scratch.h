// Memory of one sum over rings: on the stack as long as it is small, where an allocation would take
// a good part of the time.
#pragma once

#include <cstddef>

#include "base/aligned_array.h"
#include "base/poison.h"

namespace rholm {

class RingScratch {
 public:
  // n numbers, not set.
  explicit RingScratch(std::size_t n) {
    if (n > kOnStack) {
      heap_ = AlignedArray<double>(n);
    } else {
      poison_scratch(stack_, n * sizeof(double));
    }
  }
  double* data() { return heap_.size() > 0 ? heap_.data() : stack_; }

 private:
  static constexpr std::size_t kOnStack = 4096;  // 32 KiB: enough for about L = 2000
  alignas(64) double stack_[kOnStack];
  AlignedArray<double> heap_;
};

}  // namespace rholm
