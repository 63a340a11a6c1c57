#include "edit/patch/patch_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "edit/patch/patch_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "atlas/cap/opened_sphere-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kCapLanes>;
using V = hn::Vec<D>;

// Directions closer to the pole opposite the axis, where the plane ends, are moved there.
constexpr double kLeastBelow = 1e-3;

void Rows(const CapFrame& frame, int degree, const double* offsets, std::size_t n, double* rows,
          double* area) {
  const D d;
  const V one = hn::Set(d, 1.0);
  const LaneFrame<double> f = lane_frame<double>(frame);
  const V least = hn::Set(d, kLeastBelow * frame.radius);
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const CapRay<V> ray =
        RayTo(d, f,
              ToFrame(d, f, hn::LoadU(d, offsets + i), hn::LoadU(d, offsets + n + i),
                      hn::LoadU(d, offsets + 2 * n + i)));
    const V below = hn::Div(one, hn::Max(least, hn::Add(ray.rho, ray.z)));
    const OpenedPlace<V> place = OpenBelow(d, f, ray, below);
    const V factor = ConformalFactor(d, f, place);
    hn::StoreU(hn::MulSub(ray.rho, hn::Set(d, 1 / frame.radius), one), d, rows + i);
    hn::StoreU(hn::Mul(factor, factor), d, area + i);
    V re = one, im = one;
    VisitLowHarmonics(
        d, degree, place.at, [&](int, V b0, V b1, V, V) HWY_ATTR { re = b0, im = b1; },
        [&](int l, int m, V p, V) HWY_ATTR {
          if (!in_patch_basis(l, m)) return;
          double* const row = rows + (1 + patch_index(l, m)) * n + i;
          hn::StoreU(hn::Mul(p, re), d, row);
          if (m > 0) hn::StoreU(hn::Mul(p, im), d, row + n);
        });
  }
}

void Sum(const double* rows, const double* coefficients, std::size_t count, std::size_t n,
         double* out) {
  const D d;
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    V sum = hn::Zero(d);
    for (std::size_t k = 0; k < count; ++k) {
      sum = hn::MulAdd(hn::Set(d, coefficients[k]), hn::LoadU(d, rows + k * n + i), sum);
    }
    hn::StoreU(sum, d, out + i);
  }
}

// Each row is loaded once for four sets.
void Sums(const double* rows, const double* coefficients, int degree, std::size_t n, double* out,
          std::size_t stride) {
  const D d;
  const std::size_t count = patch_basis(degree);
  for (int top = degree; top >= 0; top -= 4) {
    const int low = top < 3 ? 0 : top - 3;
    // Unused sets repeat the lowest one.
    const double* set[4];
    for (int s = 0; s < 4; ++s) {
      set[s] = coefficients + count * static_cast<std::size_t>(top - s < low ? low : top - s);
    }
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
      V sum0 = hn::Zero(d), sum1 = sum0, sum2 = sum0, sum3 = sum0;
      for (std::size_t k = 0; k < patch_basis(top); ++k) {
        const V row = hn::LoadU(d, rows + k * n + i);
        sum0 = hn::MulAdd(hn::Set(d, set[0][k]), row, sum0);
        sum1 = hn::MulAdd(hn::Set(d, set[1][k]), row, sum1);
        sum2 = hn::MulAdd(hn::Set(d, set[2][k]), row, sum2);
        sum3 = hn::MulAdd(hn::Set(d, set[3][k]), row, sum3);
      }
      double* const to = out + stride * static_cast<std::size_t>(top) + i;
      hn::StoreU(sum0, d, to);
      if (top - 1 >= low) hn::StoreU(sum1, d, to - stride);
      if (top - 2 >= low) hn::StoreU(sum2, d, to - 2 * stride);
      if (top - 3 >= low) hn::StoreU(sum3, d, to - 3 * stride);
    }
  }
}

void ZeroWeightsWithin(const double* offsets, std::size_t n, const double* at, double radius,
                       double* weights) {
  const D d;
  const V x = hn::Set(d, at[0]), y = hn::Set(d, at[1]), z = hn::Set(d, at[2]);
  const V square = hn::Set(d, radius * radius);
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const V dx = hn::Sub(hn::LoadU(d, offsets + i), x);
    const V dy = hn::Sub(hn::LoadU(d, offsets + n + i), y);
    const V dz = hn::Sub(hn::LoadU(d, offsets + 2 * n + i), z);
    const V far = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
    const V weight = hn::LoadU(d, weights + i);
    hn::StoreU(hn::IfThenZeroElse(hn::Lt(far, square), weight), d, weights + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {
HWY_EXPORT(Rows);
HWY_EXPORT(Sum);
HWY_EXPORT(Sums);
HWY_EXPORT(ZeroWeightsWithin);
}  // namespace

void patch_rows(const CapFrame& frame, int degree, const double* offsets, std::size_t n,
                double* rows, double* area) {
  HWY_DYNAMIC_DISPATCH(Rows)(frame, degree, offsets, n, rows, area);
}

void patch_sum(const double* rows, const double* coefficients, std::size_t count, std::size_t n,
               double* out) {
  HWY_DYNAMIC_DISPATCH(Sum)(rows, coefficients, count, n, out);
}

void patch_sums(const double* rows, const double* coefficients, int degree, std::size_t n,
                double* out, std::size_t stride) {
  HWY_DYNAMIC_DISPATCH(Sums)(rows, coefficients, degree, n, out, stride);
}

void zero_weights_within(const double* offsets, std::size_t n, const double* at, double radius,
                         double* weights) {
  HWY_DYNAMIC_DISPATCH(ZeroWeightsWithin)(offsets, n, at, radius, weights);
}

}  // namespace rholm
#endif
