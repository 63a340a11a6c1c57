// A block of rings goes through three phases as the degree grows. While it is hidden, all its
// values are negligible and only the recurrence runs. While it is mixed, some lanes still have a
// scaled exponent. When it is whole, no tests are needed.
#include "harmonic/rings/ring_kernels.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harmonic/rings/ring_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef RHOLM_RING_KERNELS_ONCE
#define RHOLM_RING_KERNELS_ONCE
namespace rholm {

// Values below this are left out: half a unit in the last place of 1, divided by 2048 terms that
// may all be equal.
constexpr double kNegligible = 0x1p-64;

// Number of steps between tests of the exponents. A step multiplies values by less than 2^16 for
// degrees up to 2^14, where alpha^2 < 2^15 + 3. Eight steps multiply by less than 2^128, so that
// values from 2^480 do not overflow.
constexpr std::size_t kStepsPerLook = 8;

// Number of steps, [step][4][lane], whose sums stay in the first-level cache for all rings.
constexpr std::size_t kStepsAtOnce = 64;

enum class Phase : std::uint8_t { kHidden, kMixed, kWhole, kSkipped };

// The factors of a step, with index j, and the variable that they multiply.
struct StepFactors {
  StepKind kind;
  bool of_sin;  // y = s^2 if true, otherwise x^2
  const double* f[3];
};

}  // namespace rholm
#endif  // RHOLM_RING_KERNELS_ONCE

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

// Number of vectors in a block; the forward sums need 4 + 3 registers for each.
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
constexpr int kVectors = 4;
#else
constexpr int kVectors = 2;
#endif

// Values are u 2^(960 k), k <= 0; a value with k < 0 is far below kNegligible.
constexpr double kBig = 0x1p480;
constexpr double kDown = 0x1p-960;

struct Block {
  V y[kVectors];  // x^2, s^2 or, in kEither blocks, x^2 or -s^2
  V u[kVectors];  // lambda_j, or r_j
  V v[kVectors];  // lambda_{j-1}, delta_j, or p_j
  V k[kVectors];
};

HWY_INLINE size_t block_size(D d) { return kVectors * hn::Lanes(d); }

// Returns 2^f for |f| <= 1/2 and slightly more: Taylor series of e^{f ln 2}, last term 4e-18.
HWY_INLINE V exp2_fraction(D d, V f) {
  constexpr double kCoefficients[] = {1. / 6227020800,
                                      1. / 479001600,
                                      1. / 39916800,
                                      1. / 3628800,
                                      1. / 362880,
                                      1. / 40320,
                                      1. / 5040,
                                      1. / 720,
                                      1. / 120,
                                      1. / 24,
                                      1. / 6,
                                      0.5,
                                      1.,
                                      1.};
  const V z = hn::Mul(f, hn::Set(d, 0.693147180559945309417));
  V sum = hn::Set(d, kCoefficients[0]);
  for (int n = 1; n < 14; ++n) sum = hn::MulAdd(sum, z, hn::Set(d, kCoefficients[n]));
  return sum;
}

// Returns 2^e for whole |e| < 1023: the lowest bits of 2^52 + 1023 + e are the exponent's bits.
HWY_INLINE V exp2_whole(D d, V e) {
  const hn::RebindToUnsigned<D> du;
  const V shifted = hn::Add(e, hn::Set(d, 0x1p52 + 1023));
  return hn::BitCast(d, hn::ShiftLeft<52>(hn::BitCast(du, shifted)));
}

// Computes Pt_mm = mu s^m = mu 2^(m log2 s).
HWY_INLINE void start(D d, const RingOrder& order, const HalfRings& rings, size_t at, StepKind kind,
                      Block& b) {
  const V m = hn::Set(d, order.m);
  for (int i = 0; i < kVectors; ++i, at += hn::Lanes(d)) {
    const V log2 = hn::Mul(hn::Load(d, rings.log2_sin.data() + at), m);  // exact
    const V whole = hn::Round(log2);
    const V rest = hn::Load(d, rings.log2_sin_rest.data() + at);
    const V fraction = hn::MulAdd(rest, m, hn::Sub(log2, whole));
    b.k[i] = hn::Round(hn::Mul(whole, hn::Set(d, 1.0 / 960)));
    const V e = hn::NegMulAdd(b.k[i], hn::Set(d, 960.0), whole);
    const V value = hn::Mul(hn::Set(d, order.mu), exp2_fraction(d, fraction));
    b.u[i] = hn::Mul(value, exp2_whole(d, e));
    b.v[i] = kind == StepKind::kSingle ? b.u[i] : hn::Zero(d);
  }
}

HWY_INLINE StepFactors factors_of(const RingOrder& order, const HalfRings& rings, size_t at) {
  const StepKind kind = step_kind(order, rings, at / kRingBlock);
  const double *a = order.a.data(), *b = order.b.data(), *c = order.c.data();
  switch (kind) {
    case StepKind::kPolar:
      return {kind, true, {a, order.inverse_rho.data(), order.rho.data()}};
    case StepKind::kSingle:
      return {kind, false, {order.of_r.data(), order.of_p.data(), nullptr}};
    case StepKind::kEither:
    case StepKind::kDirect:
      return {kind, false, {a, b, c}};
    case StepKind::kLambda:
      break;
  }
  // The smaller of x^2 and s^2 keeps full precision for small angles.
  if (rings.sin2[at] < rings.cos2[at]) return {kind, true, {order.minus_a.data(), c, nullptr}};
  return {kind, false, {a, b, nullptr}};
}

HWY_INLINE void load_y(D d, const StepFactors& factors, const HalfRings& rings, size_t at,
                       Block& block) {
  for (int i = 0; i < kVectors; ++i, at += hn::Lanes(d)) {
    const V x2 = hn::Load(d, rings.cos2.data() + at), s2 = hn::Load(d, rings.sin2.data() + at);
    block.y[i] = factors.of_sin ? s2 : x2;
    if (factors.kind == StepKind::kEither) {
      // At a pole, s^2 is negligible but -s^2 must be below zero.
      const V minus_s2 = hn::Neg(hn::Max(s2, hn::Set(d, 0x1p-1000)));
      block.y[i] = hn::IfThenElse(hn::Lt(s2, x2), minus_s2, x2);
    }
  }
}

// Computes lambda_{j+1} into v from lambda_j = u and lambda_{j-1} = v.
HWY_INLINE void lambda_step(D d, const StepFactors& factors, size_t j, const V* y, const V* u,
                            V* v) {
  const V f0 = hn::Set(d, factors.f[0][j]), f1 = hn::Set(d, factors.f[1][j]);
  for (int i = 0; i < kVectors; ++i) v[i] = hn::MulSub(hn::MulAdd(f0, y[i], f1), u[i], v[i]);
}

template <StepKind kKind>
HWY_INLINE void other_step(D d, const StepFactors& factors, size_t j, Block& b) {
  const V f0 = hn::Set(d, factors.f[0][j]), f1 = hn::Set(d, factors.f[1][j]);
  if constexpr (kKind == StepKind::kPolar) {
    const V f2 = hn::Set(d, factors.f[2][j]);
    for (int i = 0; i < kVectors; ++i) {
      b.v[i] = hn::NegMulAdd(hn::Mul(f0, b.y[i]), b.u[i], hn::Mul(f1, b.v[i]));
      b.u[i] = hn::MulAdd(f2, b.u[i], b.v[i]);
    }
  } else if constexpr (kKind == StepKind::kEither) {
    const V f2 = hn::Set(d, factors.f[2][j]);
    for (int i = 0; i < kVectors; ++i) {
      const V rest = hn::IfThenElse(hn::Lt(b.y[i], hn::Zero(d)), f2, f1);
      const V next = hn::MulSub(hn::MulAdd(f0, b.y[i], rest), b.u[i], b.v[i]);
      b.v[i] = b.u[i];
      b.u[i] = next;
    }
  } else {
    for (int i = 0; i < kVectors; ++i) {
      b.v[i] = hn::MulSub(hn::Mul(f0, b.y[i]), b.u[i], hn::Mul(f1, b.v[i]));
      b.u[i] = hn::Sub(b.v[i], b.u[i]);
    }
  }
}

// Runs the steps from j to end. Calls use.one(even, odd, j) with the values for even and odd parts,
// or use.two(lambda_j, lambda_{j+1}, j) if `use` takes pairs.
template <StepKind kKind, typename Use>
HWY_INLINE void run(D d, const StepFactors& factors, size_t j, size_t end, Block& b,
                    const Use& use) {
  if constexpr (kKind == StepKind::kLambda) {
    // Two steps per iteration need no copies of registers.
    for (; j + 1 < end; j += 2) {
      if constexpr (!Use::kPairs) use.one(b.u, b.u, j);
      lambda_step(d, factors, j, b.y, b.u, b.v);
      if constexpr (!Use::kPairs) use.one(b.v, b.v, j + 1);
      if constexpr (Use::kPairs) use.two(b.u, b.v, j);
      lambda_step(d, factors, j + 1, b.y, b.v, b.u);
    }
    if (j < end) {
      use.one(b.u, b.u, j);
      lambda_step(d, factors, j, b.y, b.u, b.v);
      for (int i = 0; i < kVectors; ++i) std::swap(b.u[i], b.v[i]);
    }
  } else {
    for (; j < end; ++j) {
      use.one(kKind == StepKind::kSingle ? b.v : b.u, b.u, j);
      other_step<kKind>(d, factors, j, b);
    }
  }
}

struct NoUse {
  static constexpr bool kPairs = false;
  HWY_INLINE void one(const V*, const V*, size_t) const {}
};

HWY_INLINE M visible(D d, V k) { return hn::Ge(k, hn::Zero(d)); }

HWY_INLINE void rescale(D d, Block& b) {
  for (int i = 0; i < kVectors; ++i) {
    const M grown = hn::And(hn::Gt(hn::Abs(b.u[i]), hn::Set(d, kBig)), hn::Lt(b.k[i], hn::Zero(d)));
    const V factor = hn::IfThenElse(grown, hn::Set(d, kDown), hn::Set(d, 1.0));
    b.u[i] = hn::Mul(b.u[i], factor);
    b.v[i] = hn::Mul(b.v[i], factor);
    b.k[i] = hn::Add(b.k[i], hn::IfThenElseZero(grown, hn::Set(d, 1.0)));
  }
}

HWY_INLINE bool any_counts(D d, const Block& b) {
  V largest = hn::Zero(d);
  for (int i = 0; i < kVectors; ++i) {
    largest = hn::Max(largest, hn::IfThenElseZero(visible(d, b.k[i]), hn::Abs(b.u[i])));
  }
  return !hn::AllFalse(d, hn::Gt(largest, hn::Set(d, kNegligible)));
}

HWY_INLINE Phase phase_of(D d, const Block& b) {
  V least = b.k[0];
  for (int i = 1; i < kVectors; ++i) least = hn::Min(least, b.k[i]);
  return hn::AllTrue(d, visible(d, least)) ? Phase::kWhole : Phase::kMixed;
}

HWY_INLINE Phase first_phase(D d, const RingOrder& order, const HalfRings& rings, size_t at) {
  double largest = 0;
  for (size_t i = at / kRingGroup; i * kRingGroup < at + block_size(d); ++i) {
    largest = HWY_MAX(largest, rings.largest_sin[i]);
  }
  return stays_hidden(order.m, order.degree, largest) ? Phase::kSkipped : Phase::kHidden;
}

// Runs the recurrence until a value is significant, at most to `end`; returns the step reached.
template <StepKind kKind>
HWY_INLINE size_t pass_hidden(D d, const StepFactors& factors, size_t j, size_t end, Block& b,
                              Phase& phase) {
  while (j < end) {
    const Block before = b;
    const size_t stop = HWY_MIN(j + kStepsPerLook, end);
    run<kKind>(d, factors, j, stop, b, NoUse{});
    rescale(d, b);
    if (any_counts(d, b)) {
      b = before;
      phase = phase_of(d, b);
      return j;
    }
    j = stop;
  }
  return j;
}

struct Weights {
  V w[4][kVectors];
};

HWY_INLINE Weights load_weights(D d, const HalfRings& rings, const double* const* parts,
                                size_t at) {
  Weights weights;
  for (int i = 0; i < kVectors; ++i, at += hn::Lanes(d)) {
    const V x = hn::Load(d, rings.cos_theta.data() + at);
    weights.w[0][i] = hn::LoadU(d, parts[0] + at);
    weights.w[1][i] = hn::LoadU(d, parts[1] + at);
    weights.w[2][i] = hn::Mul(x, hn::LoadU(d, parts[2] + at));
    weights.w[3][i] = hn::Mul(x, hn::LoadU(d, parts[3] + at));
  }
  return weights;
}

HWY_INLINE Weights visible_weights(D d, const Weights& weights, const Block& b) {
  Weights result;
  for (int i = 0; i < kVectors; ++i) {
    for (int part = 0; part < 4; ++part) {
      result.w[part][i] = hn::IfThenElseZero(visible(d, b.k[i]), weights.w[part][i]);
    }
  }
  return result;
}

// Adds to rows [step][4][lane].
struct RowSums {
  static constexpr bool kPairs = true;
  D d;
  const Weights& weights;
  double* HWY_RESTRICT rows;

  HWY_INLINE double* row(size_t j) const { return rows + 4 * (j % kStepsAtOnce) * hn::Lanes(d); }
  HWY_INLINE void one(const V* even, const V* odd, size_t j) const {
    for (size_t part = 0; part < 4; ++part) {
      const V* value = part < 2 ? even : odd;
      double* at = row(j) + part * hn::Lanes(d);
      V sum = hn::Load(d, at);
      for (int i = 0; i < kVectors; ++i) sum = hn::MulAdd(weights.w[part][i], value[i], sum);
      hn::Store(sum, d, at);
    }
  }
  // Eight independent chains of additions hide their latency.
  HWY_INLINE void two(const V* first, const V* second, size_t j) const {
    double* at = row(j);
    V sum[8];
    for (size_t part = 0; part < 8; ++part) sum[part] = hn::Load(d, at + part * hn::Lanes(d));
    for (int i = 0; i < kVectors; ++i) {
      for (size_t part = 0; part < 4; ++part) {
        sum[part] = hn::MulAdd(weights.w[part][i], first[i], sum[part]);
        sum[part + 4] = hn::MulAdd(weights.w[part][i], second[i], sum[part + 4]);
      }
    }
    for (size_t part = 0; part < 8; ++part) hn::Store(sum[part], d, at + part * hn::Lanes(d));
  }
};

// Adds the steps [j, end) of one block of rings, within one run of kStepsAtOnce, to its rows.
template <StepKind kKind>
HWY_INLINE void adjoint_block(D d, const StepFactors& factors, size_t j, size_t end,
                              const Weights& weights, Block& b, Phase& phase, double* rows) {
  if (phase == Phase::kHidden) j = pass_hidden<kKind>(d, factors, j, end, b, phase);
  while (phase == Phase::kMixed && j < end) {
    const size_t stop = HWY_MIN(j + kStepsPerLook, end);
    const Weights seen = visible_weights(d, weights, b);
    run<kKind>(d, factors, j, stop, b, RowSums{d, seen, rows});
    rescale(d, b);
    phase = phase_of(d, b);
    j = stop;
  }
  if (phase == Phase::kWhole) run<kKind>(d, factors, j, end, b, RowSums{d, weights, rows});
}

// Returns a vector whose lane i is the sum of the lanes of vector i.
template <size_t kCount>
HWY_INLINE V lane_sums(D d, const double* rows) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kCount > 1) {
    const V a = lane_sums<kCount / 2>(d, rows);
    const V b = lane_sums<kCount / 2>(d, rows + kCount / 2 * hn::Lanes(d));
    return hn::Add(hn::ConcatEven(d, b, a), hn::ConcatOdd(d, b, a));
  }
#endif
  return hn::Load(d, rows);
}

// The states of the recurrences of all blocks between two runs of kStepsAtOnce: u, v, k and phase.
class States {
 public:
  States(size_t padded, bool needed) : padded_(padded), room_(needed ? 4 * padded : 0) {}
  Phase phase(size_t at) const { return static_cast<Phase>(values_[3 * padded_ + at]); }
  void set_phase(size_t at, Phase phase) { values_[3 * padded_ + at] = static_cast<double>(phase); }
  void load(D d, size_t at, Block& b) const {
    for (int i = 0; i < kVectors; ++i, at += hn::Lanes(d)) {
      b.u[i] = hn::Load(d, values_ + at);
      b.v[i] = hn::Load(d, values_ + padded_ + at);
      b.k[i] = hn::Load(d, values_ + 2 * padded_ + at);
    }
  }
  void store(D d, size_t at, const Block& b) {
    for (int i = 0; i < kVectors; ++i, at += hn::Lanes(d)) {
      hn::Store(b.u[i], d, values_ + at);
      hn::Store(b.v[i], d, values_ + padded_ + at);
      hn::Store(b.k[i], d, values_ + 2 * padded_ + at);
    }
  }

 private:
  size_t padded_;
  RingScratch room_;
  double* values_ = room_.data();
};

// Adds steps [j, end) of the block at `at`; returns false if the block is not of the wanted kind.
HWY_INLINE bool add_block(D d, const RingOrder& order, const HalfRings& rings,
                          const double* const* parts, bool single, size_t at, size_t j, size_t end,
                          States& states, double* rows) {
  const StepFactors factors = factors_of(order, rings, at);
  if (factors.kind == StepKind::kDirect || (factors.kind == StepKind::kSingle) != single) {
    return false;
  }
  const bool last = end == order.n_steps();
  Phase phase = j == 0 ? first_phase(d, order, rings, at) : states.phase(at);
  if (phase != Phase::kSkipped) {
    Block b;
    if (j == 0) {
      start(d, order, rings, at, factors.kind, b);
    } else {
      states.load(d, at, b);
    }
    load_y(d, factors, rings, at, b);
    const Weights weights = load_weights(d, rings, parts, at);
    switch (factors.kind) {
      case StepKind::kDirect:
        break;
      case StepKind::kLambda:
        adjoint_block<StepKind::kLambda>(d, factors, j, end, weights, b, phase, rows);
        break;
      case StepKind::kEither:
        adjoint_block<StepKind::kEither>(d, factors, j, end, weights, b, phase, rows);
        break;
      case StepKind::kPolar:
        adjoint_block<StepKind::kPolar>(d, factors, j, end, weights, b, phase, rows);
        break;
      case StepKind::kSingle:
        adjoint_block<StepKind::kSingle>(d, factors, j, end, weights, b, phase, rows);
        break;
    }
    if (!last) states.store(d, at, b);
  }
  if (!last) states.set_phase(at, phase);
  return true;
}

bool Adjoint(const RingOrder& order, const HalfRings& rings, const double* const* parts,
             bool single, double* sums) {
  const D d;
  const size_t lanes = hn::Lanes(d), steps = order.n_steps();
  States states(rings.padded, steps > kStepsAtOnce);
  HWY_ALIGN double rows[kStepsAtOnce * 4 * 8];
  bool any = false;
  for (size_t j = 0; j < steps; j += kStepsAtOnce) {
    const size_t end = HWY_MIN(j + kStepsAtOnce, steps), n = 4 * (end - j);
    std::fill(rows, rows + (n + 7) / 8 * 8 * lanes, 0.0);
    any = false;
    for (size_t at = 0; at < rings.padded; at += block_size(d)) {
      any |= add_block(d, order, rings, parts, single, at, j, end, states, rows);
    }
    if (!any) return false;
    for (size_t i = 0; i < n; i += lanes) {
      hn::StoreU(lane_sums<hn::MaxLanes(D())>(d, rows + i * lanes), d, sums + 4 * j + i);
    }
  }
  return any;
}

struct Sums {
  V s[4][kVectors];
};

struct RingSums {
  static constexpr bool kPairs = false;
  D d;
  const double* HWY_RESTRICT terms;
  Sums& sums;

  HWY_INLINE void one(const V* even, const V* odd, size_t j) const {
    for (size_t part = 0; part < 4; ++part) {
      const V* value = part < 2 ? even : odd;
      const V term = hn::Set(d, terms[4 * j + part]);
      for (int i = 0; i < kVectors; ++i) {
        sums.s[part][i] = hn::MulAdd(term, value[i], sums.s[part][i]);
      }
    }
  }
};

template <StepKind kKind>
HWY_INLINE void forward_block(D d, const StepFactors& factors, size_t end, const double* terms,
                              Block& b, Sums& sums) {
  Phase phase = Phase::kHidden;
  size_t j = pass_hidden<kKind>(d, factors, 0, end, b, phase);
  while (phase == Phase::kMixed && j < end) {
    const size_t stop = HWY_MIN(j + kStepsPerLook, end);
    V k[kVectors];
    for (int i = 0; i < kVectors; ++i) k[i] = b.k[i];
    run<kKind>(d, factors, j, stop, b, RingSums{d, terms, sums});
    // Hidden lanes were zero before these steps but may now hold any number.
    for (int i = 0; i < kVectors; ++i) {
      for (int part = 0; part < 4; ++part) {
        sums.s[part][i] = hn::IfThenElseZero(visible(d, k[i]), sums.s[part][i]);
      }
    }
    rescale(d, b);
    phase = phase_of(d, b);
    j = stop;
  }
  if (phase == Phase::kWhole) run<kKind>(d, factors, j, end, b, RingSums{d, terms, sums});
}

void Forward(const RingOrder& order, const HalfRings& rings, const double* lambda_terms,
             const double* single_terms, double* const* parts) {
  const D d;
  const size_t steps = order.n_steps();
  for (size_t at = 0; at < rings.padded; at += block_size(d)) {
    Sums sums;
    for (int part = 0; part < 4; ++part) {
      for (int i = 0; i < kVectors; ++i) sums.s[part][i] = hn::Zero(d);
    }
    const StepFactors factors = factors_of(order, rings, at);
    if (factors.kind != StepKind::kDirect && first_phase(d, order, rings, at) != Phase::kSkipped) {
      Block b;
      start(d, order, rings, at, factors.kind, b);
      load_y(d, factors, rings, at, b);
      switch (factors.kind) {
        case StepKind::kDirect:
          break;
        case StepKind::kLambda:
          forward_block<StepKind::kLambda>(d, factors, steps, lambda_terms, b, sums);
          break;
        case StepKind::kEither:
          forward_block<StepKind::kEither>(d, factors, steps, lambda_terms, b, sums);
          break;
        case StepKind::kPolar:
          forward_block<StepKind::kPolar>(d, factors, steps, lambda_terms, b, sums);
          break;
        case StepKind::kSingle:
          forward_block<StepKind::kSingle>(d, factors, steps, single_terms, b, sums);
          break;
      }
    }
    for (int i = 0; i < kVectors; ++i) {
      const size_t to = at + static_cast<size_t>(i) * hn::Lanes(d);
      const V x = hn::Load(d, rings.cos_theta.data() + to);
      hn::StoreU(sums.s[0][i], d, parts[0] + to);
      hn::StoreU(sums.s[1][i], d, parts[1] + to);
      hn::StoreU(hn::Mul(x, sums.s[2][i]), d, parts[2] + to);
      hn::StoreU(hn::Mul(x, sums.s[3][i]), d, parts[3] + to);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(Adjoint);
HWY_EXPORT(Forward);

bool ring_step_adjoint(const RingOrder& order, const HalfRings& rings, const double* const* parts,
                       bool single, double* sums) {
  return HWY_DYNAMIC_DISPATCH(Adjoint)(order, rings, parts, single, sums);
}

void ring_step_forward(const RingOrder& order, const HalfRings& rings, const double* lambda_factors,
                       const double* single_factors, double* const* parts) {
  HWY_DYNAMIC_DISPATCH(Forward)(order, rings, lambda_factors, single_factors, parts);
}

}  // namespace rholm
#endif  // HWY_ONCE
