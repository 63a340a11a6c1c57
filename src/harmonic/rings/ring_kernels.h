// The inner loops of ring_sums.h: over rings, in lanes, and over steps j of the recurrences of
// ring_order.h.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/aligned_array.h"
#include "base/poison.h"
#include "harmonic/rings/half_rings.h"
#include "harmonic/rings/ring_order.h"

namespace rholm {

// Memory of one sum over rings: on the stack as long as it is small, where an allocation would take
// a good part of the time.
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

inline constexpr std::size_t kStepPadding = 8;  // rows of sums that are written beyond the last

// How a block of kRingBlock rings is gone through, see ring_order.h: in steps of lambda with the
// factor from x^2 or from s^2, or from either as the ring wants it; in differences; in single
// degrees. kDirect blocks, few rings far apart at a high degree, are left to legendre_kernels.h.
enum class StepKind : std::uint8_t { kLambda, kEither, kPolar, kSingle, kDirect };
StepKind step_kind(const RingOrder& order, const HalfRings& rings, std::size_t block);

// The sums over rings of kSingle blocks, or of all others but kDirect ones, in sums[4j ...]: of
// {p_j, r_j} or lambda_j times {even_re, even_im, x odd_re, x odd_im}. Returns false, and leaves
// the sums, if there is no such block.
bool ring_step_adjoint(const RingOrder& order, const HalfRings& rings, const double* const* parts,
                       bool single, double* sums);

// {even_re, even_im, odd_re, odd_im} = sum over j of factors[4j ...] times lambda_j, or {p_j, r_j}
// in kSingle blocks, the odd ones times x; zeros in kDirect blocks.
void ring_step_forward(const RingOrder& order, const HalfRings& rings, const double* lambda_factors,
                       const double* single_factors, double* const* parts);

}  // namespace rholm
