// The recurrence of legendre_order.h for several vectors of sources at once. All sums with
// associated Legendre functions share this code, which is compiled for each target.
#include <cstddef>

#include "harmonic/legendre/legendre_order.h"

#if defined(RHOLM_HARMONIC_LEGENDRE_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RHOLM_HARMONIC_LEGENDRE_BLOCK_INL_H_
#undef RHOLM_HARMONIC_LEGENDRE_BLOCK_INL_H_
#else
#define RHOLM_HARMONIC_LEGENDRE_BLOCK_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

// Values stay within 2^-480 ... 2^480 by factors of 2^960: no product of two overflows. A value
// with k < 0 is below 2^-480, and sums leave it out.
constexpr double kBig = 0x1p480;
constexpr double kSmall = 0x1p-480;
constexpr double kUp = 0x1p960;
constexpr double kDown = 0x1p-960;

// The number p 2^(960 k) in each lane.
struct Scaled {
  V p;
  V k;
};

HWY_INLINE Scaled normalise(D d, Scaled v) {
  const V size = hn::Abs(v.p);
  const M low = hn::And(hn::Lt(size, hn::Set(d, kSmall)), hn::Gt(size, hn::Zero(d)));
  v.p = hn::IfThenElse(low, hn::Mul(v.p, hn::Set(d, kUp)), v.p);
  v.k = hn::IfThenElse(low, hn::Sub(v.k, hn::Set(d, 1.0)), v.k);
  // Without this, squares of squares would leave the range of double.
  const M high = hn::Gt(size, hn::Set(d, kBig));
  v.p = hn::IfThenElse(high, hn::Mul(v.p, hn::Set(d, kDown)), v.p);
  v.k = hn::IfThenElse(high, hn::Add(v.k, hn::Set(d, 1.0)), v.k);
  return v;
}

HWY_INLINE Scaled multiply(D d, Scaled a, Scaled b) {
  return normalise(d, {hn::Mul(a.p, b.p), hn::Add(a.k, b.k)});
}

// Returns mu s^m by repeated squaring, for s in [0, 1].
HWY_INLINE Scaled start_value(D d, V s, int m, double mu) {
  Scaled result{hn::Set(d, mu), hn::Zero(d)};
  Scaled square = normalise(d, {s, hn::Zero(d)});
  for (int bits = m; bits > 0; bits >>= 1) {
    if (bits & 1) result = multiply(d, result, square);
    if (bits > 1) square = multiply(d, square, square);
  }
  return result;
}

// The state of the recurrence for a block of kVectors vectors of sources.
constexpr int kVectors = 4;

struct Block {
  V x_minus_1[kVectors];  // |x| - 1
  V sign[kVectors];       // sign bit of x: 0 or -0
  V d[kVectors];          // d_l
  V p[kVectors];          // Pt_lm(|x|)
  V k[kVectors];
  bool scaled;  // true if some lane has k < 0
};

HWY_INLINE void start(D d, const LegendreOrder& order, const double* x, const double* s, Block& b) {
  b.scaled = false;
  for (int v = 0; v < kVectors; ++v) {
    const size_t at = static_cast<size_t>(v) * hn::Lanes(d);
    const V one = hn::Set(d, 1.0);
    const V xv = hn::LoadU(d, x + at), sv = hn::LoadU(d, s + at);
    b.x_minus_1[v] = hn::Neg(hn::Div(hn::Mul(sv, sv), hn::Add(one, hn::Abs(xv))));
    b.sign[v] = hn::CopySign(hn::Zero(d), xv);
    const Scaled first = start_value(d, sv, order.m, order.mu);
    b.d[v] = hn::Zero(d);
    b.p[v] = first.p;
    b.k[v] = first.k;
    b.scaled = b.scaled || !hn::AllTrue(d, hn::Ge(first.k, hn::Zero(d)));
  }
}

// Takes the values from degree m + row to the next degree.
HWY_INLINE void advance(D d, const LegendreOrder& order, int row, Block& b) {
  const V rho = hn::Set(d, order.rho[row]);
  const V of_difference = hn::Set(d, order.of_difference[row]);
  const V of_value = hn::Set(d, order.of_value[row]);
  for (int v = 0; v < kVectors; ++v) {
    b.d[v] = hn::MulAdd(hn::Mul(of_value, b.x_minus_1[v]), b.p[v], hn::Mul(of_difference, b.d[v]));
    b.p[v] = hn::MulAdd(rho, b.p[v], b.d[v]);
  }
}

// After advance(), while some lane has k < 0: rescales the lanes whose values have grown.
HWY_INLINE void rescale(D d, Block& b) {
  b.scaled = false;
  for (int v = 0; v < kVectors; ++v) {
    const M grown = hn::And(hn::Gt(hn::Abs(b.p[v]), hn::Set(d, kBig)), hn::Lt(b.k[v], hn::Zero(d)));
    b.d[v] = hn::IfThenElse(grown, hn::Mul(b.d[v], hn::Set(d, kDown)), b.d[v]);
    b.p[v] = hn::IfThenElse(grown, hn::Mul(b.p[v], hn::Set(d, kDown)), b.p[v]);
    b.k[v] = hn::IfThenElse(grown, hn::Add(b.k[v], hn::Set(d, 1.0)), b.k[v]);
    b.scaled = b.scaled || !hn::AllTrue(d, hn::Ge(b.k[v], hn::Zero(d)));
  }
}

// Returns Pt_lm in `values`, or 0 in lanes that are still below 2^-480.
HWY_INLINE void visible(D d, const Block& b, V* values) {
  for (int v = 0; v < kVectors; ++v) {
    values[v] = hn::IfThenElseZero(hn::Ge(b.k[v], hn::Zero(d)), b.p[v]);
  }
}

HWY_INLINE bool any_visible(D d, const Block& b) {
  bool any = false;
  for (int v = 0; v < kVectors; ++v) any = any || !hn::AllFalse(d, hn::Ge(b.k[v], hn::Zero(d)));
  return any;
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#endif  // include guard, for each target
