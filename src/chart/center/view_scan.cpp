#include "chart/center/view_scan.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "chart/center/view_scan.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "chart/center/visit_chosen-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// Smallest square of a normal in the unit frame; a smaller square loses its digits.
constexpr double kSmallestSquare = 1e-280;
// sin^2 of an angle below which the plain product of double edges has lost 7 bits; then the visitor
// computes the exact product. Edges between floats and their products are exact in double.
constexpr double kIllConditioned = 0x1p-14;

// Visits the triangles for which test.Choose(corners) is true, and calls test.Refresh() after
// visits. Corners have the coordinates of the mesh.
template <class T, class Test>
HWY_INLINE void VisitIf(const MeshView& mesh, std::size_t begin, std::size_t end, Test test,
                        const VisitTriangle& visit) {
  const D d;
  const auto look = [&](const Vector3& a, const Vector3& b, const Vector3& c, std::size_t t,
                        std::size_t n) HWY_ATTR {
    const M chosen = test.Choose(d, a, b, c);
    if (HWY_LIKELY(hn::AllFalse(d, chosen))) return;
    VisitChosen(d, chosen, t, n, visit);
    test.Refresh(d);
  };
  ForVectors<T>(mesh, begin, end, look);
}

// Doubles are scaled to the unit frame, so that nothing overflows or underflows. No product of
// floats can overflow here, so the frame is scaled to floats instead.
template <class T>
constexpr bool kScaled = sizeof(T) == 8;

struct Lookout {
  Vector3 middle, center;  // middle of the frame; centre of the view, relative to the middle
  V scale;

  HWY_INLINE Lookout(D d, const UnitFrame& frame, double unit, const Vec3& from)
      : middle(Same(d, frame.center / unit)),
        center(Same(d, from / unit)),
        scale(hn::Set(d, frame.scale)) {}
  HWY_INLINE Vector3 Ray(const Vector3& corner) const {
    return Minus(Minus(corner, middle), center);
  }
  template <class T>
  HWY_INLINE Vector3 Scaled(const Vector3& v) const {
    if constexpr (!kScaled<T>) return v;
    return {hn::Mul(v.x, scale), hn::Mul(v.y, scale), hn::Mul(v.z, scale)};
  }
};

HWY_INLINE double SignedSquare(double x) { return x * std::abs(x); }

template <class T, bool kCosine>
struct BelowTest {
  Lookout from;
  double unit;
  const ScanLimits& limits;
  V distance, cosine;  // signed squares of the limits

  HWY_INLINE BelowTest(D d, const LocalView& view, const Vec3& center, const ScanLimits& l)
      : from(d, view.frame, kScaled<T> ? 1 : view.frame.scale, center),
        unit(kScaled<T> ? 1 : view.frame.scale),
        limits(l) {
    Refresh(d);
  }
  HWY_INLINE void Refresh(D d) {
    distance = hn::Set(d, SignedSquare(limits.distance / unit));
    if constexpr (kCosine) cosine = hn::Set(d, SignedSquare(limits.cosine));
  }
  HWY_INLINE M Choose(D d, const Vector3& raw0, const Vector3& raw1, const Vector3& raw2) const {
    const Vector3 corner0 = from.Scaled<T>(raw0);
    const Vector3 corner1 = from.Scaled<T>(raw1), corner2 = from.Scaled<T>(raw2);
    const Vector3 edge1 = Minus(corner1, corner0), edge2 = Minus(corner2, corner0);
    const Vector3 normal = Cross(edge1, edge2), ray = from.Ray(corner0);
    const V height = Dot(normal, ray), square = Dot(normal, normal);
    // Tests d_T < limit, with both sides squared and their signs kept.
    const V signed_height = hn::Mul(height, hn::Abs(height));
    M chosen = hn::Lt(signed_height, hn::Mul(distance, square));
    if constexpr (kScaled<T>) {
      const V product = hn::Mul(Dot(edge1, edge1), Dot(edge2, edge2));
      const V least = hn::MulAdd(product, hn::Set(d, kIllConditioned), hn::Set(d, kSmallestSquare));
      chosen = hn::Or(chosen, hn::Lt(square, least));
    }
    if constexpr (kCosine) {
      const Vector3 ray1 = from.Ray(corner1), ray2 = from.Ray(corner2);
      const V a = Dot(ray, ray), b = Dot(ray1, ray1), c = Dot(ray2, ray2);
      // cos gamma is smallest at the farthest corner if d_T > 0, at the nearest otherwise.
      const V length = hn::IfThenElse(hn::Gt(height, hn::Zero(d)), hn::Max(a, hn::Max(b, c)),
                                      hn::Min(a, hn::Min(b, c)));
      chosen = hn::Or(chosen, hn::Lt(signed_height, hn::Mul(cosine, hn::Mul(square, length))));
    }
    return chosen;
  }
};

template <class T, bool kCosine>
HWY_INLINE void BelowOf(const LocalView& view, std::size_t begin, std::size_t end,
                        const Vec3& center, const ScanLimits& limits, const VisitTriangle& visit) {
  VisitIf<T>(view.mesh, begin, end, BelowTest<T, kCosine>(D(), view, center, limits), visit);
}

void Below(const LocalView& view, std::size_t begin, std::size_t end, const Vec3& center,
           const ScanLimits& limits, const VisitTriangle& visit) {
  const bool cosine = limits.cosine > -std::numeric_limits<double>::infinity();
  if (view.mesh.coordinate == ScalarType::kFloat32) {
    if (cosine) return BelowOf<float, true>(view, begin, end, center, limits, visit);
    return BelowOf<float, false>(view, begin, end, center, limits, visit);
  }
  if (cosine) return BelowOf<double, true>(view, begin, end, center, limits, visit);
  BelowOf<double, false>(view, begin, end, center, limits, visit);
}

template <class T>
struct LineTest {
  Lookout from;
  Vector3 along;

  HWY_INLINE LineTest(D d, const LocalView& view, const Vec3& center, const Vec3& direction)
      : from(d, view.frame, kScaled<T> ? 1 : view.frame.scale, center), along(Same(d, direction)) {}
  HWY_INLINE void Refresh(D) const {}
  struct Side {
    V height, rounding;
  };
  HWY_INLINE Side SideOf(D d, const Vector3& a, const Vector3& b) const {
    // Twice the rounding of the product, 8 2^-53 of the lengths, because a^2 + b^2 >= 2 a b.
    return {Dot(Cross(a, b), along),
            hn::Mul(hn::Add(Dot(a, a), Dot(b, b)), hn::Set(d, 8 * 0x1p-53))};
  }
  HWY_INLINE M Choose(D d, const Vector3& raw0, const Vector3& raw1, const Vector3& raw2) const {
    const Vector3 a = from.Ray(from.Scaled<T>(raw0)), b = from.Ray(from.Scaled<T>(raw1));
    const Vector3 c = from.Ray(from.Scaled<T>(raw2));
    const Side s0 = SideOf(d, a, b), s1 = SideOf(d, b, c), s2 = SideOf(d, c, a);
    const V zero = hn::Zero(d);
    const auto inside = [&](const Side& s)
                            HWY_ATTR { return hn::Ge(hn::Add(s.height, s.rounding), zero); };
    const M chosen = hn::And(inside(s0), hn::And(inside(s1), inside(s2)));
    const auto beyond = [&](const Side& s) HWY_ATTR { return hn::Le(s.height, s.rounding); };
    return hn::Or(chosen, hn::And(beyond(s0), hn::And(beyond(s1), beyond(s2))));
  }
};

void Lines(const LocalView& view, std::size_t begin, std::size_t end, const Vec3& center,
           const Vec3& direction, const VisitTriangle& visit) {
  const D d;
  if (view.mesh.coordinate == ScalarType::kFloat32) {
    return VisitIf<float>(view.mesh, begin, end, LineTest<float>(d, view, center, direction),
                          visit);
  }
  VisitIf<double>(view.mesh, begin, end, LineTest<double>(d, view, center, direction), visit);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(Below);
HWY_EXPORT(Lines);

void scan_below(const LocalView& view, std::size_t begin, std::size_t end, const Vec3& center,
                const ScanLimits& limits, const VisitTriangle& visit) {
  HWY_DYNAMIC_DISPATCH(Below)(view, begin, end, center, limits, visit);
}

void scan_lines(const LocalView& view, std::size_t begin, std::size_t end, const Vec3& center,
                const Vec3& direction, const VisitTriangle& visit) {
  HWY_DYNAMIC_DISPATCH(Lines)(view, begin, end, center, direction, visit);
}

}  // namespace rholm
#endif  // HWY_ONCE
