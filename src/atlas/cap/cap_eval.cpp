#include "atlas/cap/cap_eval.h"

#include <array>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "atlas/cap/cap_eval.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "atlas/cap/cap_limits.h"
#include "harmonic/legendre/low_harmonics-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kCapLanes>;
using V = hn::Vec<D>;

struct At {
  V lx, ly, lz, rho;      // from the centre, in the frame
  V t1, t2;               // stereographic plane, not opened
  V level, g1, g2, flat;  // r / R_0; grad r / r along the tangents; 1 / sqrt(1 + its square)
  hn::Mask<D> valid;
};

HWY_INLINE V Turn(D d, const Vec3& a, V x, V y, V z) {
  return hn::MulAdd(hn::Set(d, a.x), x,
                    hn::MulAdd(hn::Set(d, a.y), y, hn::Mul(hn::Set(d, a.z), z)));
}

HWY_INLINE At Look(D d, const Cap& cap, const double* coefficients, V px, V py, V pz) {
  const CapFrame& f = cap.frame;
  const V one = hn::Set(d, 1.0);
  At at;
  at.lx = Turn(d, f.x, px, py, pz), at.ly = Turn(d, f.y, px, py, pz);
  at.lz = hn::Add(Turn(d, f.z, px, py, pz), hn::Set(d, f.radius));
  at.rho = hn::Sqrt(hn::MulAdd(at.lx, at.lx, hn::MulAdd(at.ly, at.ly, hn::Mul(at.lz, at.lz))));
  const V below = hn::Div(one, hn::Add(at.rho, at.lz));
  at.t1 = hn::Mul(at.lx, below), at.t2 = hn::Mul(at.ly, below);
  const V a = hn::Set(d, f.dilation);
  LowDirection<V> low;
  low.s1 = hn::Mul(a, at.t1), low.s2 = hn::Mul(a, at.t2);
  const V opened = hn::Div(one, hn::MulAdd(low.s1, low.s1, hn::MulAdd(low.s2, low.s2, one)));
  const V over = hn::Add(opened, opened);
  low.x = hn::Mul(low.s1, over), low.y = hn::Mul(low.s2, over), low.z = hn::Sub(over, one);
  const LowSum<V> sum =
      SumLowHarmonics(d, cap.degree, cap.basis == CapBasis::kEven, coefficients, low);
  at.level = hn::Add(one, sum.value);
  const V factor =
      hn::Mul(hn::Mul(a, hn::MulAdd(at.t1, at.t1, hn::MulAdd(at.t2, at.t2, one))), opened);
  const V slope = hn::Div(factor, at.level);
  at.g1 = hn::Mul(slope, sum.d1), at.g2 = hn::Mul(slope, sum.d2);
  at.flat = hn::Div(one, hn::Sqrt(hn::MulAdd(at.g1, at.g1, hn::MulAdd(at.g2, at.g2, one))));
  at.valid = hn::And(hn::Gt(at.lz, hn::Mul(at.rho, hn::Set(d, kLeastAhead))),
                     hn::Gt(at.level, hn::Set(d, kLeastLevel)));
  return at;
}

void Distances(const Cap& cap, const double* coefficients, const CapPoints& points,
               double* distance) {
  const D d;
  for (std::size_t i = 0; i < points.size(); i += hn::Lanes(d)) {
    const At at = Look(d, cap, coefficients, hn::Load(d, points.row(0) + i),
                       hn::Load(d, points.row(1) + i), hn::Load(d, points.row(2) + i));
    const V g = hn::Mul(hn::NegMulAdd(hn::Set(d, cap.frame.radius), at.level, at.rho), at.flat);
    hn::StoreU(hn::IfThenElse(at.valid, g, hn::Set(d, std::numeric_limits<double>::quiet_NaN())), d,
               distance + i);
  }
}

void Surface(const Cap& cap, const double* coefficients, const CapPoints& points,
             std::size_t stride, double* positions, double* normals) {
  const D d;
  const CapFrame& f = cap.frame;
  const std::array<std::array<double, 3>, 3> axes = {
      {{f.x.x, f.y.x, f.z.x}, {f.x.y, f.y.y, f.z.y}, {f.x.z, f.y.z, f.z.z}}};
  const V nan = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < points.size(); i += hn::Lanes(d)) {
    const At at = Look(d, cap, coefficients, hn::Load(d, points.row(0) + i),
                       hn::Load(d, points.row(1) + i), hn::Load(d, points.row(2) + i));
    const V inverse = hn::Div(hn::Set(d, 1.0), at.rho);
    const V ux = hn::Mul(at.lx, inverse), uy = hn::Mul(at.ly, inverse);
    const V uz = hn::Mul(at.lz, inverse);
    // u - grad r / r; the tangents of the plane's axes are e_i - t_i (u + e_3).
    const V both = hn::MulAdd(at.g1, at.t1, hn::Mul(at.g2, at.t2));
    const V nx = hn::Mul(at.flat, hn::Sub(hn::MulAdd(both, ux, ux), at.g1));
    const V ny = hn::Mul(at.flat, hn::Sub(hn::MulAdd(both, uy, uy), at.g2));
    const V nz = hn::Mul(at.flat, hn::MulAdd(both, hn::Add(uz, hn::Set(d, 1.0)), uz));
    const V r = hn::Mul(hn::Set(d, f.radius), at.level);
    const V x = hn::Mul(r, ux), y = hn::Mul(r, uy);
    const V z = hn::MulSub(r, uz, hn::Set(d, f.radius));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const V a = hn::Set(d, axes[axis][0]), b = hn::Set(d, axes[axis][1]);
      const V c = hn::Set(d, axes[axis][2]);
      const V p = hn::MulAdd(a, x, hn::MulAdd(b, y, hn::Mul(c, z)));
      const V n = hn::MulAdd(a, nx, hn::MulAdd(b, ny, hn::Mul(c, nz)));
      hn::StoreU(hn::IfThenElse(at.valid, p, nan), d, positions + axis * stride + i);
      hn::StoreU(hn::IfThenElse(at.valid, n, nan), d, normals + axis * stride + i);
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
