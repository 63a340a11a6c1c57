// Harmonics of low degree in the lanes of a vector. Kernels include this file once per target.

#if defined(RHOLM_HARMONIC_LOW_HARMONICS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RHOLM_HARMONIC_LOW_HARMONICS_INL_H_
#undef RHOLM_HARMONIC_LOW_HARMONICS_INL_H_
#else
#define RHOLM_HARMONIC_LOW_HARMONICS_INL_H_
#endif

#include <hwy/highway.h>

#include "harmonic/legendre/low_harmonics.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Directions in lanes: a point (x, y, z) of the sphere, and its stereographic projection from the
// south pole, (s1, s2) = (X, Y) / (1 + Z).
template <class V>
struct LowDirection {
  V x, y, z, s1, s2;
};

// Calls visit(l, m, p, dp) with p_lm(Z) and its derivative for all orders and degrees, all degrees
// of one order after another. Before each order, calls begin(m, re, im, re_below, im_below) with
// (X + iY)^m and (X + iY)^(m-1).
template <class D, class Begin, class Visit>
HWY_INLINE void VisitLowHarmonics(D d, int degree, const LowDirection<hn::Vec<D>>& at,
                                  const Begin& begin, const Visit& visit) {
  using V = hn::Vec<D>;
  using T = hn::TFromD<D>;
  const LowHarmonics& h = low_harmonics();
  V re = hn::Set(d, T(1)), im = hn::Zero(d), re_below = hn::Zero(d), im_below = hn::Zero(d);
  for (int m = 0; m <= degree; ++m) {
    begin(m, re, im, re_below, im_below);
    V p0 = hn::Zero(d), p1 = hn::Set(d, static_cast<T>(h.start[m]));
    V d0 = hn::Zero(d), d1 = hn::Zero(d);
    visit(m, m, p1, d1);
    for (int l = m + 1; l <= degree; ++l) {
      const V a = hn::Set(d, static_cast<T>(h.a[m][l])), b = hn::Set(d, static_cast<T>(h.b[m][l]));
      const V p2 = hn::Mul(a, hn::MulSub(at.z, p1, hn::Mul(b, p0)));
      const V d2 = hn::Mul(a, hn::Add(p1, hn::MulSub(at.z, d1, hn::Mul(b, d0))));
      visit(l, m, p2, d2);
      p0 = p1, p1 = p2, d0 = d1, d1 = d2;
    }
    re_below = re, im_below = im;
    const V next = hn::MulSub(at.x, re, hn::Mul(at.y, im));
    im = hn::MulAdd(at.x, im, hn::Mul(at.y, re));
    re = next;
  }
}

// Does the same for even l + m, with the derivative with respect to Z^2.
template <class D, class Begin, class Visit>
HWY_INLINE void VisitEvenHarmonics(D d, int degree, const LowDirection<hn::Vec<D>>& at,
                                   const Begin& begin, const Visit& visit) {
  using V = hn::Vec<D>;
  using T = hn::TFromD<D>;
  const EvenHarmonics& h = even_harmonics();
  const V z2 = hn::Mul(at.z, at.z);
  V re = hn::Set(d, T(1)), im = hn::Zero(d), re_below = hn::Zero(d), im_below = hn::Zero(d);
  for (int m = 0; m <= degree; ++m) {
    begin(m, re, im, re_below, im_below);
    V p0 = hn::Zero(d), p1 = hn::Set(d, static_cast<T>(h.start[m]));
    V d0 = hn::Zero(d), d1 = hn::Zero(d);
    for (int l = m;; l += 2) {
      visit(l, m, p1, d1);
      if (l + 2 > degree) break;
      const V a = hn::Set(d, static_cast<T>(h.a[m][l])), c = hn::Set(d, static_cast<T>(h.c[m][l]));
      const V times = hn::MulSub(a, z2, hn::Set(d, static_cast<T>(h.b[m][l])));
      const V d2 = hn::MulAdd(a, p1, hn::MulSub(times, d1, hn::Mul(c, d0)));
      const V p2 = hn::MulSub(times, p1, hn::Mul(c, p0));
      p0 = p1, p1 = p2, d0 = d1, d1 = d2;
    }
    re_below = re, im_below = im;
    const V next = hn::MulSub(at.x, re, hn::Mul(at.y, im));
    im = hn::MulAdd(at.x, im, hn::Mul(at.y, re));
    re = next;
  }
}

// A sum of harmonics and its derivatives along the two unit tangents of the axes of the plane.
template <class V>
struct LowSum {
  V value, d1, d2;
};

// Returns sum_i c_i Y_i for coefficients in the order of atlas.h, of the even or the full basis.
template <class D>
HWY_INLINE LowSum<hn::Vec<D>> SumLowHarmonics(D d, int degree, bool even, const hn::TFromD<D>* c,
                                              const LowDirection<hn::Vec<D>>& at) {
  using V = hn::Vec<D>;
  LowSum<V> sum{hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  // For one order: the sums of p c and of p s, and the sums of their derivatives.
  V re = hn::Zero(d), im = re, re_below = re, im_below = re;
  V pc = hn::Zero(d), ps = pc, dc = pc, ds = pc;
  V up = hn::Add(at.z, hn::Set(d, hn::TFromD<D>(1)));
  if (even) up = hn::Mul(up, hn::Add(at.z, at.z));  // derivatives are with respect to Z^2
  const auto finish = [&](int m) HWY_ATTR {
    // f = A pc + B ps, A + iB = (X + iY)^m. Along e_1: pc dA/dX + ps dB/dX - s1 (m f + (1 + Z) f').
    const V order = hn::Set(d, static_cast<hn::TFromD<D>>(m));
    const V f = hn::MulAdd(pc, re, hn::Mul(ps, im));
    const V slope = hn::MulAdd(order, f, hn::Mul(up, hn::MulAdd(dc, re, hn::Mul(ds, im))));
    const V along1 = hn::Mul(order, hn::MulAdd(pc, re_below, hn::Mul(ps, im_below)));
    const V along2 = hn::Mul(order, hn::MulSub(ps, re_below, hn::Mul(pc, im_below)));
    sum.value = hn::Add(sum.value, f);
    sum.d1 = hn::Add(sum.d1, hn::NegMulAdd(at.s1, slope, along1));
    sum.d2 = hn::Add(sum.d2, hn::NegMulAdd(at.s2, slope, along2));
  };
  const auto begin = [&](int m, V a, V b, V a_below, V b_below) HWY_ATTR {
    if (m > 0) finish(m - 1);
    re = a, im = b, re_below = a_below, im_below = b_below;
    pc = ps = dc = ds = hn::Zero(d);
  };
  const auto add = [&](const hn::TFromD<D>* at_lm, int m, V p, V dp) HWY_ATTR {
    const V cosine = hn::Set(d, at_lm[0]);
    pc = hn::MulAdd(p, cosine, pc);
    dc = hn::MulAdd(dp, cosine, dc);
    if (m == 0) return;
    const V sine = hn::Set(d, at_lm[1]);
    ps = hn::MulAdd(p, sine, ps);
    ds = hn::MulAdd(dp, sine, ds);
  };
  if (even) {
    VisitEvenHarmonics(d, degree, at, begin, [&](int l, int m, V p, V dp) HWY_ATTR {
      add(c + even_index(l, m), m, p, dp);
    });
  } else {
    VisitLowHarmonics(d, degree, at, begin, [&](int l, int m, V p, V dp) HWY_ATTR {
      add(c + low_index(l, m), m, p, dp);
    });
  }
  finish(degree);
  return sum;
}

// Returns the sum of all harmonics up to kDegree from the coefficients that to_powers() computes,
// by Horner's rule in Z for each order.
template <int kDegree, class D>
HWY_INLINE LowSum<hn::Vec<D>> SumPowers(D d, const hn::TFromD<D>* c,
                                        const LowDirection<hn::Vec<D>>& at) {
  using V = hn::Vec<D>;
  const auto horner = [&](int n, std::size_t stride, V& value, V& slope) HWY_ATTR {
    value = hn::Set(d, c[0]), slope = hn::Zero(d);
    for (int i = 1; i <= n; ++i) {
      slope = i == 1 ? value : hn::MulAdd(slope, at.z, value);
      value = hn::MulAdd(value, at.z, hn::Set(d, c[static_cast<std::size_t>(i) * stride]));
    }
  };
  LowSum<V> sum;
  V along_z, turn = hn::Zero(d);
  horner(kDegree, 1, sum.value, along_z);
  c += kDegree + 1;
  sum.d1 = sum.d2 = hn::Zero(d);
  V re_below = hn::Set(d, hn::TFromD<D>(1)), im_below = hn::Zero(d);
  for (int m = 1; m <= kDegree; ++m) {
    const V re = m == 1 ? at.x : hn::MulSub(at.x, re_below, hn::Mul(at.y, im_below));
    const V im = m == 1 ? at.y : hn::MulAdd(at.x, im_below, hn::Mul(at.y, re_below));
    V pc, ps, dc, ds;
    horner(kDegree - m, 2, pc, dc);
    ++c;
    horner(kDegree - m, 2, ps, ds);
    c += 2 * (kDegree - m) + 1;
    const V order = hn::Set(d, static_cast<hn::TFromD<D>>(m));
    const V f = hn::MulAdd(pc, re, hn::Mul(ps, im));
    sum.value = hn::Add(sum.value, f);
    turn = hn::MulAdd(order, f, turn);
    if (m < kDegree) along_z = hn::MulAdd(dc, re, hn::MulAdd(ds, im, along_z));
    const V fx = m == 1 ? pc : hn::MulAdd(pc, re_below, hn::Mul(ps, im_below));
    const V fy = m == 1 ? ps : hn::MulSub(ps, re_below, hn::Mul(pc, im_below));
    sum.d1 = hn::MulAdd(order, fx, sum.d1);
    sum.d2 = hn::MulAdd(order, fy, sum.d2);
    re_below = re, im_below = im;
  }
  // Adds u . grad f + df/dZ as SumLowHarmonics() does.
  turn = hn::MulAdd(hn::Add(at.z, hn::Set(d, hn::TFromD<D>(1))), along_z, turn);
  sum.d1 = hn::NegMulAdd(at.s1, turn, sum.d1);
  sum.d2 = hn::NegMulAdd(at.s2, turn, sum.d2);
  return sum;
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#endif
