// Points near a cap, in the lanes of a vector: their positions in its frame
// and on its opened sphere, and the cap's surface there (method 7.1, 7.5).
// Works in single or double precision. Included once per target, by kernels.

#if defined(RHOLM_ATLAS_OPENED_SPHERE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RHOLM_ATLAS_OPENED_SPHERE_INL_H_
#undef RHOLM_ATLAS_OPENED_SPHERE_INL_H_
#else
#define RHOLM_ATLAS_OPENED_SPHERE_INL_H_
#endif

#include <hwy/highway.h>

#include "atlas/cap/cap_limits.h"
#include "atlas/cap/lane_frame.h"
#include "harmonic/legendre/low_harmonics-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

template <class V>
struct Lanes3 {
  V x, y, z;
};

// Returns a x + b y + c z for numbers a, b, c and vectors x, y, z.
template <class D, class V = hn::Vec<D>, class T = hn::TFromD<D>>
HWY_INLINE V Dot(D d, T a, T b, T c, V x, V y, V z) {
  return hn::MulAdd(hn::Set(d, a), x, hn::MulAdd(hn::Set(d, b), y, hn::Mul(hn::Set(d, c), z)));
}

// Converts a vector in space to components along a cap's axes.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Lanes3<V> ToFrame(D d, const LaneFrame<hn::TFromD<D>>& f, V x, V y, V z) {
  return {Dot(d, f.x[0], f.x[1], f.x[2], x, y, z), Dot(d, f.y[0], f.y[1], f.y[2], x, y, z),
          Dot(d, f.z[0], f.z[1], f.z[2], x, y, z)};
}

// Converts back: returns the component along an axis of space.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V FromFrame(D d, const LaneFrame<hn::TFromD<D>>& f, int axis, const Lanes3<V>& v) {
  return Dot(d, f.x[axis], f.y[axis], f.z[axis], v.x, v.y, v.z);
}

// Vector from the centre along the cap's axes, and its length rho.
template <class V>
struct CapRay {
  V x, y, z, rho;
};

// Returns the ray to an offset from the seed along the axes; the seed is R_0 above the centre.
template <class D, class V = hn::Vec<D>>
HWY_INLINE CapRay<V> RayTo(D d, const LaneFrame<hn::TFromD<D>>& f, const Lanes3<V>& at) {
  CapRay<V> ray{at.x, at.y, hn::Add(at.z, hn::Set(d, f.radius)), at.z};
  ray.rho = hn::Sqrt(hn::MulAdd(ray.x, ray.x, hn::MulAdd(ray.y, ray.y, hn::Mul(ray.z, ray.z))));
  return ray;
}

// Position where a ray meets the sphere.
template <class V>
struct OpenedPlace {
  V s1, s2;            // place in the stereographic plane, not opened
  LowDirection<V> at;  // place on the opened sphere, and in its plane
  V shrink;            // 1 / (1 + |a s|^2)
};

// `below` is 1 / (rho + z), so s = (x, y) / (rho + z). The result is not finite
// opposite the axis and at the centre, unless the caller bounds `below`.
template <class D, class V = hn::Vec<D>>
HWY_INLINE OpenedPlace<V> OpenBelow(D d, const LaneFrame<hn::TFromD<D>>& f, const CapRay<V>& ray,
                                    V below) {
  const V one = hn::Set(d, hn::TFromD<D>(1)), a = hn::Set(d, f.dilation);
  OpenedPlace<V> place;
  place.s1 = hn::Mul(ray.x, below), place.s2 = hn::Mul(ray.y, below);
  LowDirection<V>& at = place.at;
  at.s1 = hn::Mul(a, place.s1), at.s2 = hn::Mul(a, place.s2);
  place.shrink = hn::Div(one, hn::MulAdd(at.s1, at.s1, hn::MulAdd(at.s2, at.s2, one)));
  const V twice = hn::Add(place.shrink, place.shrink);
  at.x = hn::Mul(at.s1, twice), at.y = hn::Mul(at.s2, twice), at.z = hn::Sub(twice, one);
  return place;
}
template <class D, class V = hn::Vec<D>>
HWY_INLINE OpenedPlace<V> Open(D d, const LaneFrame<hn::TFromD<D>>& f, const CapRay<V>& ray) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  return OpenBelow(d, f, ray, hn::Div(one, hn::Add(ray.rho, ray.z)));
}

// Returns kappa of (K1): the growth of lengths on the sphere when it is opened.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V ConformalFactor(D d, const LaneFrame<hn::TFromD<D>>& f, const OpenedPlace<V>& place) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const V closed = hn::MulAdd(place.s1, place.s1, hn::MulAdd(place.s2, place.s2, one));
  return hn::Mul(hn::Mul(hn::Set(d, f.dilation), closed), place.shrink);
}

// The cap's surface on a ray.
template <class V>
struct CapLevel {
  V level;     // r / R_0
  V g1, g2;    // grad_u r / r along the tangents of the plane's axes, not opened
  V flatness;  // 1 / sqrt(1 + |grad_u r|^2 / r^2)
};

// Computes the surface from phi and its slopes on the opened sphere.
template <class D, class V = hn::Vec<D>>
HWY_INLINE CapLevel<V> LevelOf(D d, const LaneFrame<hn::TFromD<D>>& f, const OpenedPlace<V>& place,
                               const LowSum<V>& phi) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  CapLevel<V> here;
  here.level = hn::Add(one, phi.value);
  const V opened = ConformalFactor(d, f, place), inverse = hn::Div(one, here.level);
  const V h1 = hn::Mul(opened, phi.d1), h2 = hn::Mul(opened, phi.d2);
  here.g1 = hn::Mul(h1, inverse), here.g2 = hn::Mul(h2, inverse);
  const V square = hn::MulAdd(h1, h1, hn::MulAdd(h2, h2, hn::Mul(here.level, here.level)));
  here.flatness = hn::Div(hn::Abs(here.level), hn::Sqrt(square));
  return here;
}

// Returns g of (K3).
template <class D, class V = hn::Vec<D>>
HWY_INLINE V Potential(D d, const LaneFrame<hn::TFromD<D>>& f, const CapRay<V>& ray,
                       const CapLevel<V>& here) {
  return hn::Mul(hn::NegMulAdd(hn::Set(d, f.radius), here.level, ray.rho), here.flatness);
}

// Returns true where the potential exists: the point and the surface lie ahead of the centre.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> HasPotential(D d, const CapRay<V>& ray, const CapLevel<V>& here) {
  using T = hn::TFromD<D>;
  return hn::And(hn::Gt(ray.z, hn::Mul(ray.rho, hn::Set(d, static_cast<T>(kLeastAhead)))),
                 hn::Gt(here.level, hn::Set(d, static_cast<T>(kLeastLevel))));
}

// Returns the unit vector along the ray.
template <class D, class V = hn::Vec<D>>
HWY_INLINE Lanes3<V> DirectionOf(D d, const CapRay<V>& ray) {
  const V inverse = hn::Div(hn::Set(d, hn::TFromD<D>(1)), ray.rho);
  return {hn::Mul(ray.x, inverse), hn::Mul(ray.y, inverse), hn::Mul(ray.z, inverse)};
}

// Returns the surface's unit normal in the direction u, along the cap's axes:
// u - grad_u r / r. The tangents of the plane's axes are e_i - s_i (u + e_3).
template <class D, class V = hn::Vec<D>>
HWY_INLINE Lanes3<V> NormalOf(D d, const Lanes3<V>& u, const OpenedPlace<V>& place,
                              const CapLevel<V>& here) {
  const V one = hn::Set(d, hn::TFromD<D>(1));
  const V both = hn::MulAdd(here.g1, place.s1, hn::Mul(here.g2, place.s2));
  return {hn::Mul(here.flatness, hn::Sub(hn::MulAdd(both, u.x, u.x), here.g1)),
          hn::Mul(here.flatness, hn::Sub(hn::MulAdd(both, u.y, u.y), here.g2)),
          hn::Mul(here.flatness, hn::MulAdd(both, hn::Add(u.z, one), u.z))};
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#endif
