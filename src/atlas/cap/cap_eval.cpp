#include "atlas/cap/cap_eval.h"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "atlas/cap/cap_eval.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "atlas/cap/opened_sphere-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kCapLanes>;
using V = hn::Vec<D>;

// The cap's surface at offsets from its seed.
struct Seen {
  CapRay<V> ray;
  OpenedPlace<V> place;
  CapLevel<V> here;
  hn::Mask<D> valid;
};

HWY_INLINE Seen Look(D d, const Cap& cap, const LaneFrame<double>& frame,
                     const double* coefficients, const CapPoints& points, std::size_t i) {
  Seen seen;
  seen.ray = RayTo(d, frame,
                   ToFrame(d, frame, hn::Load(d, points.row(0) + i), hn::Load(d, points.row(1) + i),
                           hn::Load(d, points.row(2) + i)));
  seen.place = Open(d, frame, seen.ray);
  const LowSum<V> phi =
      SumLowHarmonics(d, cap.degree, cap.basis == CapBasis::kEven, coefficients, seen.place.at);
  seen.here = LevelOf(d, frame, seen.place, phi);
  seen.valid = HasPotential(d, seen.ray, seen.here);
  return seen;
}

void Distances(const Cap& cap, const double* coefficients, const CapPoints& points,
               double* distance) {
  const D d;
  const LaneFrame<double> frame = lane_frame<double>(cap.frame);
  const V nan = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < points.size(); i += hn::Lanes(d)) {
    const Seen seen = Look(d, cap, frame, coefficients, points, i);
    const V g = Potential(d, frame, seen.ray, seen.here);
    hn::StoreU(hn::IfThenElse(seen.valid, g, nan), d, distance + i);
  }
}

void Surface(const Cap& cap, const double* coefficients, const CapPoints& points,
             std::size_t stride, double* positions, double* normals) {
  const D d;
  const LaneFrame<double> frame = lane_frame<double>(cap.frame);
  const V nan = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  const V radius = hn::Set(d, frame.radius);
  for (std::size_t i = 0; i < points.size(); i += hn::Lanes(d)) {
    const Seen seen = Look(d, cap, frame, coefficients, points, i);
    const Lanes3<V> u = DirectionOf(d, seen.ray);
    const Lanes3<V> normal = NormalOf(d, u, seen.place, seen.here);
    const V r = hn::Mul(radius, seen.here.level);
    const Lanes3<V> foot{hn::Mul(r, u.x), hn::Mul(r, u.y), hn::MulSub(r, u.z, radius)};
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t at = static_cast<std::size_t>(axis) * stride + i;
      const V p = FromFrame(d, frame, axis, foot), n = FromFrame(d, frame, axis, normal);
      hn::StoreU(hn::IfThenElse(seen.valid, p, nan), d, positions + at);
      hn::StoreU(hn::IfThenElse(seen.valid, n, nan), d, normals + at);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {
HWY_EXPORT(Distances);
HWY_EXPORT(Surface);
}  // namespace

void cap_distances(const Cap& cap, std::span<const double> coefficients, const CapPoints& points,
                   std::span<double> distance) {
  HWY_DYNAMIC_DISPATCH(Distances)(cap, coefficients.data(), points, distance.data());
}

void cap_surface(const Cap& cap, std::span<const double> coefficients, const CapPoints& points,
                 std::span<double> positions, std::span<double> normals) {
  HWY_DYNAMIC_DISPATCH(Surface)
  (cap, coefficients.data(), points, positions.size() / 3, positions.data(), normals.data());
}

}  // namespace rholm
#endif
