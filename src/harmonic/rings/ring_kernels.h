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

// Memory for one sum over rings. It is on the stack if it is small, where an allocation would take
// a large part of the time.
class RingScratch {
 public:
  // Reserves n numbers, which are not initialised.
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

inline constexpr std::size_t kStepPadding = 8;  // rows of sums that are written beyond the last one

// The recurrence of a block of kRingBlock rings, see ring_order.h. Steps of lambda use x^2 or s^2
// per block (kLambda) or per ring (kEither); kPolar uses differences, kSingle single degrees.
// Blocks of distant rings at a high degree (kDirect) use legendre_kernels.h.
enum class StepKind : std::uint8_t { kLambda, kEither, kPolar, kSingle, kDirect };
StepKind step_kind(const RingOrder& order, const HalfRings& rings, std::size_t block);

// Sums over the rings of kSingle blocks if `single`, otherwise of all others but kDirect ones. The
// entries sums[4j ...] are for {p_j, r_j} or lambda_j times {even_re, even_im, x odd_re, x odd_im}.
// Returns false, and leaves the sums unchanged, if there is no such block.
bool ring_step_adjoint(const RingOrder& order, const HalfRings& rings, const double* const* parts,
                       bool single, double* sums);

// Sums factors[4j ...] times lambda_j, or {p_j, r_j} in kSingle blocks, over j into {even_re,
// even_im, odd_re, odd_im}, the odd sums times x. kDirect blocks get zeros.
void ring_step_forward(const RingOrder& order, const HalfRings& rings, const double* lambda_factors,
                       const double* single_factors, double* const* parts);

}  // namespace rholm
