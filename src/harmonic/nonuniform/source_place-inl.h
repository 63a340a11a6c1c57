// Positions of sources on the grid, and their derivatives by position in units of grid steps: inner
// loops of spread.cpp, compiled for each target.
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numbers>

#include "harmonic/nonuniform/spread.h"

#if defined(RHOLM_HARMONIC_SOURCE_PLACE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RHOLM_HARMONIC_SOURCE_PLACE_INL_H_
#undef RHOLM_HARMONIC_SOURCE_PLACE_INL_H_
#else
#define RHOLM_HARMONIC_SOURCE_PLACE_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Number of sources in a block: their windows stay in the first-level cache (scripts/constants).
template <typename T>
constexpr size_t kBlock = 512 / sizeof(T);

// Positions of sources on the grid, and the factors of the function and its derivatives in steps.
template <typename T>
struct Placed {
  alignas(64) T x[3][kBlock<T>];
  alignas(64) int32_t row[kBlock<T>];
  alignas(64) int32_t column[kBlock<T>];
  alignas(64) T u_theta[kBlock<T>];  // 2 (c0 - x) - 1
  alignas(64) T u_phi[kBlock<T>];
  alignas(64) T value[kBlock<T>];
  alignas(64) T theta[kBlock<T>];
  alignas(64) T phi[kBlock<T>];
  alignas(64) T theta_theta[kBlock<T>];
  alignas(64) T theta_phi[kBlock<T>];
  alignas(64) T phi_phi[kBlock<T>];
};

// atan(x) / x as a polynomial in x^2, |x| <= tan(pi/8), through its values at Chebyshev nodes
// (computed in extended precision). The relative error is 2^-40, which suffices for windows in
// single precision, and 2^-59 for double precision.
constexpr double kAtanForSingle[] = {
    0.9999999999992447616, -0.3333333327692249070, 0.1999999305355568210, -0.1428538655374759761,
    0.1110345690887282952, -0.0899255290552062902, 0.0697419768394907185, -0.0376551059691399053};
constexpr double kAtanForDouble[] = {
    0.9999999999999999987,   -0.3333333333333312116,  0.1999999999994089146,
    -0.1428571427925024494,  0.1111111074491965824,   -0.09090896809064027076,
    0.07692045330902224952,  -0.06662951813629190088, 0.0584687829733087252,
    -0.05035102456601551843, 0.03796525745386593624,  -0.01780539720541944523};
template <typename T>
constexpr auto& atan_powers() {
  if constexpr (sizeof(T) == sizeof(float)) {
    return kAtanForSingle;
  } else {
    return kAtanForDouble;
  }
}
template <typename T, class D, class V = hn::Vec<D>>
HWY_INLINE V short_atan(D d, V x) {
  const V xx = hn::Mul(x, x);
  constexpr auto& c = atan_powers<T>();
  constexpr int n = static_cast<int>(std::size(c));
  // Two shorter dependency chains, for even and for odd powers of x^2.
  const V x4 = hn::Mul(xx, xx);
  V even = hn::Set(d, c[n - 2]), odd = hn::Set(d, c[n - 1]);
  for (int q = n - 4; q >= 0; q -= 2) {
    even = hn::MulAdd(even, x4, hn::Set(d, c[q]));
    odd = hn::MulAdd(odd, x4, hn::Set(d, c[q + 1]));
  }
  return hn::Mul(x, hn::MulAdd(odd, xx, even));
}

// The angle eighth pi/4 + rest, where |rest| <= pi/8.
template <class V>
struct Angle {
  V eighth, rest;
};

// Returns the angle of the direction (x, y), in [0, 2 pi], for windows in T.
template <typename T, class D, class V = hn::Vec<D>>
HWY_INLINE Angle<V> angle_of(D d, V y, V x) {
  const V zero = hn::Zero(d);
  const auto steep = hn::Gt(hn::Abs(y), hn::Abs(x));
  // Quarters: 0 or, just before a full turn, 4 around +x; 1 around +y; 2 around -x; 3 around -y.
  const auto negative_y = hn::Lt(y, zero);
  const V near_x = hn::IfThenElse(hn::Lt(x, zero), hn::Set(d, 4.0),
                                  hn::IfThenElseZero(negative_y, hn::Set(d, 8.0)));
  const V near_y = hn::IfThenElse(negative_y, hn::Set(d, 6.0), hn::Set(d, 2.0));
  const V quarter = hn::IfThenElse(steep, near_y, near_x);
  // The tangent is measured from the middle of the quarter; its denominator is made positive.
  const V base = hn::IfThenElse(steep, y, x);
  const V across = hn::IfThenElse(steep, hn::Neg(x), y);
  const V den = hn::Abs(base);
  const V num = hn::Xor(across, hn::And(base, hn::SignBit(d)));
  // The angle is measured from the end of the quarter if that is nearer.
  const V sign = hn::And(num, hn::SignBit(d));
  const V size = hn::Abs(num);
  const auto outer = hn::Gt(size, hn::Mul(den, hn::Set(d, 0.41421356237309503)));
  const V from_end = hn::Xor(hn::Sub(size, den), sign);
  const V top = hn::IfThenElse(outer, from_end, num);
  const V bottom = hn::IfThenElse(outer, hn::Add(den, size), den);
  const V step = hn::IfThenElseZero(outer, hn::Or(hn::Set(d, 1.0), sign));
  const V tangent = hn::IfThenZeroElse(hn::Eq(bottom, zero), hn::Div(top, bottom));
  return {hn::Add(quarter, step), short_atan<T>(d, tangent)};
}

// Stores integers limited to 0 ... last, for any input.
template <class D>
HWY_INLINE void store_integers(D, hn::Vec<D> v, size_t last, int32_t* to) {
  const hn::Rebind<int32_t, D> di;
  const auto most = hn::Set(di, static_cast<int32_t>(last));
  hn::Store(hn::Min(hn::Max(hn::DemoteTo(di, v), hn::Zero(di)), most), di, to);
}

template <class D>
HWY_INLINE void store_as(D d, hn::Vec<D> v, double* to) {
  hn::Store(v, d, to);
}
template <class D>
HWY_INLINE void store_as(D, hn::Vec<D> v, float* to) {
  const hn::Rebind<float, D> df;
  hn::Store(hn::DemoteTo(df, v), df, to);
}

// Returns the number of grid steps per radian.
template <typename T>
T steps(size_t n) {
  return static_cast<T>(static_cast<double>(n) / (2 * std::numbers::pi));
}

// Stores the first tap and the distance from it for an angle of at most `last` steps, n a turn.
template <class D, typename T>
HWY_INLINE void store_place(D d, const Angle<hn::Vec<D>>& angle, size_t n, size_t last,
                            int32_t* first, T* u) {
  const auto base = hn::Mul(angle.eighth, hn::Set(d, static_cast<double>(n) / 8));
  const auto rest = hn::Mul(angle.rest, hn::Set(d, steps<double>(n)));
  const auto cell = hn::Ceil(hn::Add(base, rest));
  const auto distance = hn::Sub(hn::Sub(cell, base), rest);
  store_as(d, hn::MulAdd(hn::Set(d, 2.0), distance, hn::Set(d, -1.0)), u);
  store_integers(d, cell, last, first);
}

// Finds angles in double precision for windows in single precision, too. A rounded direction moves
// by L 2^-25 wave lengths, equally for neighbours, and this does not average out.
template <typename T>
HWY_INLINE void place(const GridLayout& layout, const SourceBatch<T>& batch, size_t from,
                      size_t count, Placed<T>& out) {
  const hn::CappedTag<double, 16> d;
  const size_t padded = (count + 15) / 16 * 16;  // lanes of T are read in full
  for (size_t at = 0; at < padded; at += hn::MaxLanes(d)) {
    const auto x = hn::Load(d, batch.x[0] + from + at), y = hn::Load(d, batch.x[1] + from + at);
    const auto z = hn::Load(d, batch.x[2] + from + at);
    const auto s = hn::Sqrt(hn::MulAdd(x, x, hn::Mul(y, y)));
    store_as(d, x, out.x[0] + at);
    store_as(d, y, out.x[1] + at);
    store_as(d, z, out.x[2] + at);
    store_place(d, angle_of<T>(d, s, z), layout.n_theta, layout.n_theta / 2, out.row + at,
                out.u_theta + at);
    store_place(d, angle_of<T>(d, y, x), layout.n_phi, layout.n_phi, out.column + at,
                out.u_phi + at);
  }
}

// The local frame of a source, and the factors that turn derivatives into grid steps.
template <class V>
struct Frame {
  V inverse_r, inverse_sine, cos_theta, sin_theta, cos_phi, sin_phi;
};

template <class D, typename T = hn::TFromD<D>>
HWY_INLINE Frame<hn::Vec<D>> frame_of(D d, const Placed<T>& placed, size_t at) {
  using V = hn::Vec<D>;
  const V x = hn::Load(d, placed.x[0] + at), y = hn::Load(d, placed.x[1] + at);
  const V z = hn::Load(d, placed.x[2] + at);
  const V ss = hn::MulAdd(x, x, hn::Mul(y, y));
  const V s = hn::Sqrt(ss), r = hn::Sqrt(hn::MulAdd(z, z, ss));
  const V one = hn::Set(d, T{1});
  const auto on_axis = hn::Eq(s, hn::Zero(d));
  const V inverse_s = hn::IfThenZeroElse(on_axis, hn::Div(one, s));
  Frame<V> frame;
  frame.inverse_r = hn::Div(one, r);
  frame.sin_theta = hn::Mul(s, frame.inverse_r);
  frame.cos_theta = hn::Mul(z, frame.inverse_r);
  frame.inverse_sine = hn::Mul(inverse_s, r);
  frame.cos_phi = hn::IfThenElse(on_axis, one, hn::Mul(x, inverse_s));
  frame.sin_phi = hn::Mul(y, inverse_s);
  return frame;
}

// For a function of direction alone, f_theta = r (g . e_theta), f_phi = r sin(theta) (g . e_phi).
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void place_gradient(D d, const GridLayout& layout, const SourceBatch<T>& batch,
                               size_t from, size_t at, const Frame<hn::Vec<D>>& f, Placed<T>& out) {
  using V = hn::Vec<D>;
  const V gx = hn::Load(d, batch.gradient[0] + from + at),
          gy = hn::Load(d, batch.gradient[1] + from + at);
  const V gz = hn::Load(d, batch.gradient[2] + from + at);
  const V outward = hn::MulAdd(gx, f.cos_phi, hn::Mul(gy, f.sin_phi));
  const V along = hn::NegMulAdd(gx, f.sin_phi, hn::Mul(gy, f.cos_phi));
  const V theta = hn::NegMulAdd(gz, f.sin_theta, hn::Mul(outward, f.cos_theta));
  const V per_theta = hn::Mul(f.inverse_r, hn::Set(d, steps<T>(layout.n_theta)));
  const V per_phi =
      hn::Mul(hn::Mul(f.inverse_r, f.inverse_sine), hn::Set(d, steps<T>(layout.n_phi)));
  hn::Store(hn::Mul(theta, per_theta), d, out.theta + at);
  hn::Store(hn::Mul(along, per_phi), d, out.phi + at);
}

// Computes h_ij d_i d_j f for a function of direction alone. In components of (r, theta, phi),
//   r^2 times it = h_tt f_tt + 2 h_tp (f_tp - cot f_p) / sin + h_pp (f_pp / sin^2 + cot f_t)
//                  - 2 h_rt f_t - 2 h_rp f_p / sin.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void place_hessian(D d, const GridLayout& layout, const SourceBatch<T>& batch,
                              size_t from, size_t at, const Frame<hn::Vec<D>>& f, Placed<T>& out) {
  using V = hn::Vec<D>;
  V h[6];
  for (int i = 0; i < 6; ++i) h[i] = hn::Load(d, batch.hessian[i] + from + at);
  const auto apply = [&](V a, V b, V c, V& x, V& y, V& z) HWY_ATTR {
    x = hn::MulAdd(h[0], a, hn::MulAdd(h[1], b, hn::Mul(h[2], c)));
    y = hn::MulAdd(h[1], a, hn::MulAdd(h[3], b, hn::Mul(h[4], c)));
    z = hn::MulAdd(h[2], a, hn::MulAdd(h[4], b, hn::Mul(h[5], c)));
  };
  const V tx = hn::Mul(f.cos_theta, f.cos_phi), ty = hn::Mul(f.cos_theta, f.sin_phi);
  const V tz = hn::Neg(f.sin_theta);
  const V rx = hn::Mul(f.sin_theta, f.cos_phi), ry = hn::Mul(f.sin_theta, f.sin_phi);
  V x, y, z;
  apply(tx, ty, tz, x, y, z);
  const V tt = hn::MulAdd(x, tx, hn::MulAdd(y, ty, hn::Mul(z, tz)));
  const V rt = hn::MulAdd(x, rx, hn::MulAdd(y, ry, hn::Mul(z, f.cos_theta)));
  apply(hn::Neg(f.sin_phi), f.cos_phi, hn::Zero(d), x, y, z);
  const V tp = hn::MulAdd(x, tx, hn::MulAdd(y, ty, hn::Mul(z, tz)));
  const V rp = hn::MulAdd(x, rx, hn::MulAdd(y, ry, hn::Mul(z, f.cos_theta)));
  const V pp = hn::NegMulAdd(x, f.sin_phi, hn::Mul(y, f.cos_phi));
  const V two = hn::Set(d, T{2});
  const V cot = hn::Mul(f.cos_theta, f.inverse_sine);
  const V per_theta = hn::Mul(f.inverse_r, hn::Set(d, steps<T>(layout.n_theta)));
  const V per_phi =
      hn::Mul(hn::Mul(f.inverse_r, f.inverse_sine), hn::Set(d, steps<T>(layout.n_phi)));
  const V of_theta = hn::Mul(hn::NegMulAdd(two, rt, hn::Mul(pp, cot)), f.inverse_r);
  const V of_phi = hn::Mul(hn::Mul(two, hn::Neg(hn::MulAdd(tp, cot, rp))), f.inverse_r);
  hn::Store(hn::MulAdd(of_theta, per_theta, hn::Load(d, out.theta + at)), d, out.theta + at);
  hn::Store(hn::MulAdd(of_phi, per_phi, hn::Load(d, out.phi + at)), d, out.phi + at);
  hn::Store(hn::Mul(tt, hn::Mul(per_theta, per_theta)), d, out.theta_theta + at);
  hn::Store(hn::Mul(hn::Mul(two, tp), hn::Mul(per_theta, per_phi)), d, out.theta_phi + at);
  hn::Store(hn::Mul(pp, hn::Mul(per_phi, per_phi)), d, out.phi_phi + at);
}

// Lists the sources whose sin theta is below the limit.
template <class D, typename T = hn::TFromD<D>>
HWY_INLINE void list_polar(D d, const Frame<hn::Vec<D>>& frame, T limit, size_t at, size_t n,
                           PolarSources& polar) {
  const auto near = hn::Lt(frame.sin_theta, hn::Set(d, limit));
  if (HWY_LIKELY(hn::AllFalse(d, near))) return;
  alignas(64) T sine[hn::MaxLanes(d)];
  hn::Store(frame.sin_theta, d, sine);
  for (size_t i = 0; i < hn::MaxLanes(d) && at + i < n; ++i) {
    if (sine[i] < limit) polar.index[polar.count++] = static_cast<uint32_t>(at + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#endif  // include guard, for each target
