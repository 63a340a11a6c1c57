#include "chart/center/slope_scan.h"

#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "chart/center/slope_scan.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "chart/center/visit_chosen-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A face with a smaller squared normal has no area: in the unit frame the square loses its digits.
constexpr double kNoArea = 1e-280;

// Sums the derivative at the middle of each face. A face has the normal n, whose length is twice
// the area, and x is the vector from the place t to its middle m. With h = n . x, d = h / |n|, d' =
// -n . way / |n| and rho rho' = -m . way, the derivative is
//   (|n|^2 rho^2 + h^2) (n.way rho^2 - m.way h) / (2 h^2 rho^3).
template <class T, bool kOne>
void RisesOf(const LocalView& view, std::size_t begin, std::size_t end, const SlopeLine& line,
             const Places& places, const VisitTriangle& visit, Rises& rises) {
  const D d;
  const V scale = hn::Set(d, view.frame.scale), third = hn::Set(d, 1.0 / 3);
  const Vector3 frame = Same(d, view.frame.center), start = Same(d, line.middle);
  const Vector3 way = Same(d, line.way);
  const V way2 = hn::Set(d, dot(line.way, line.way)), least = hn::Set(d, line.least);
  const V least2 = hn::Mul(least, least), no_area = hn::Set(d, kNoArea);
  const V large2 = hn::Set(d, 4 * kSmallFace * kSmallFace), half = hn::Set(d, 0.5);
  const V t0 = hn::Set(d, places[0]), t1 = hn::Set(d, places[1]);
  const V t2 = hn::Set(d, places[2]), t3 = hn::Set(d, places[3]);
  V sum0 = hn::Zero(d), sum1 = sum0, sum2 = sum0, sum3 = sum0;
  M too_near = hn::FirstN(d, 0);
  const auto local = [&](const Vector3& raw) HWY_ATTR -> Vector3 {
    return {hn::MulSub(raw.x, scale, frame.x), hn::MulSub(raw.y, scale, frame.y),
            hn::MulSub(raw.z, scale, frame.z)};
  };
  ForVectors<T>(
      view.mesh, begin, end,
      [&](const Vector3& raw0, const Vector3& raw1, const Vector3& raw2, std::size_t at,
          std::size_t n) HWY_ATTR {
        const Vector3 a = local(raw0);
        const Vector3 edge1 = Minus(local(raw1), a), edge2 = Minus(local(raw2), a);
        const Vector3 normal = Cross(edge1, edge2), ray = Minus(a, start);
        const Vector3 m = {hn::MulAdd(hn::Add(edge1.x, edge2.x), third, ray.x),
                           hn::MulAdd(hn::Add(edge1.y, edge2.y), third, ray.y),
                           hn::MulAdd(hn::Add(edge1.z, edge2.z), third, ray.z)};
        const V square = Dot(normal, normal), height = Dot(normal, ray), climb = Dot(normal, way);
        const V rho2 = Dot(m, m), along = Dot(m, way);
        const M large = hn::Ge(square, hn::Mul(large2, hn::Mul(rho2, rho2)));
        if (HWY_UNLIKELY(!hn::AllFalse(d, large))) VisitChosen(d, large, at, n, visit);
        const M small = hn::AndNot(large, hn::And(hn::Gt(square, no_area), hn::FirstN(d, n)));
        const V lowest = hn::Mul(least, hn::Sqrt(square));
        const auto rise = [&](V t) HWY_ATTR {
          const V h = hn::Max(hn::NegMulAdd(t, climb, height), lowest), h2 = hn::Mul(h, h);
          const V q = hn::NegMulAdd(t, way2, along);
          const V r2 = hn::Max(hn::NegMulAdd(t, hn::Add(along, q), rho2), least2);
          const V product =
              hn::Mul(hn::MulAdd(square, r2, h2), hn::NegMulAdd(q, h, hn::Mul(climb, r2)));
          const V below = hn::Mul(hn::Mul(h2, r2), hn::Sqrt(r2));
          return hn::IfThenElseZero(small, hn::Div(hn::Mul(half, product), below));
        };
        sum0 = hn::Add(sum0, rise(t0));
        if constexpr (kOne) return;
        const V nearest =
            hn::Min(hn::NegMulAdd(t0, climb, height), hn::NegMulAdd(t3, climb, height));
        too_near = hn::Or(too_near, hn::And(small, hn::Lt(nearest, lowest)));
        sum1 = hn::Add(sum1, rise(t1));
        sum2 = hn::Add(sum2, rise(t2));
        sum3 = hn::Add(sum3, rise(t3));
      });
  const auto whole = [&](V sum) HWY_ATTR { return hn::GetLane(hn::SumOfLanes(d, sum)); };
  rises = {.sums = {whole(sum0), whole(sum1), whole(sum2), whole(sum3)},
           .too_near = !hn::AllFalse(d, too_near)};
}

void Rises(const LocalView& view, std::size_t begin, std::size_t end, const SlopeLine& line,
           const Places& places, std::size_t n, const VisitTriangle& visit, Rises& rises) {
  if (view.mesh.coordinate == ScalarType::kFloat32) {
    if (n == 1) return RisesOf<float, true>(view, begin, end, line, places, visit, rises);
    return RisesOf<float, false>(view, begin, end, line, places, visit, rises);
  }
  if (n == 1) return RisesOf<double, true>(view, begin, end, line, places, visit, rises);
  RisesOf<double, false>(view, begin, end, line, places, visit, rises);
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(Rises);

Rises sum_rises(const LocalView& view, std::size_t begin, std::size_t end, const SlopeLine& line,
                const Places& places, std::size_t n, const VisitTriangle& visit) {
  Rises rises;
  HWY_DYNAMIC_DISPATCH(Rises)(view, begin, end, line, places, n, visit, rises);
  return rises;
}

}  // namespace rholm
#endif  // HWY_ONCE
