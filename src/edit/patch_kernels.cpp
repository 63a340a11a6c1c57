#include "edit/patch_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "edit/patch_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "harmonic/low_harmonics-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kPatchLanes>;
using V = hn::Vec<D>;

// Directions this close to the one opposite the axis, where the plane ends, are taken as there.
constexpr double kLowest = 1e-3;

HWY_INLINE V Along(D d, const Vec3& a, V x, V y, V z) {
  return hn::MulAdd(hn::Set(d, a.x), x,
                    hn::MulAdd(hn::Set(d, a.y), y, hn::Mul(hn::Set(d, a.z), z)));
}

void Rows(const CapFrame& frame, int degree, const double* offsets, std::size_t n, double* rows,
          double* area) {
  const D d;
  const V one = hn::Set(d, 1.0);
  const V a = hn::Set(d, frame.dilation);
  for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
    const V x = hn::LoadU(d, offsets + i), y = hn::LoadU(d, offsets + n + i);
    const V z = hn::LoadU(d, offsets + 2 * n + i);
    const V lx = Along(d, frame.x, x, y, z), ly = Along(d, frame.y, x, y, z);
    const V lz = hn::Add(Along(d, frame.z, x, y, z), hn::Set(d, frame.radius));
    const V rho = hn::Sqrt(hn::MulAdd(lx, lx, hn::MulAdd(ly, ly, hn::Mul(lz, lz))));
    const V least = hn::Set(d, kLowest * frame.radius);
    const V below = hn::Div(one, hn::Max(least, hn::Add(rho, lz)));
    const V t1 = hn::Mul(lx, below), t2 = hn::Mul(ly, below);
    LowDirection<V> at;
    at.s1 = hn::Mul(a, t1), at.s2 = hn::Mul(a, t2);
    const V opened = hn::MulAdd(at.s1, at.s1, hn::MulAdd(at.s2, at.s2, one));
    const V over = hn::Div(hn::Set(d, 2.0), opened);
    at.x = hn::Mul(at.s1, over), at.y = hn::Mul(at.s2, over), at.z = hn::Sub(over, one);
    const V closed = hn::MulAdd(t1, t1, hn::MulAdd(t2, t2, one));
    const V factor = hn::Div(hn::Mul(a, closed), opened);
    hn::StoreU(hn::MulSub(rho, hn::Set(d, 1 / frame.radius), one), d, rows + i);
    hn::StoreU(hn::Mul(factor, factor), d, area + i);
    V re = one, im = one;
    VisitLowHarmonics(
        d, degree, at, [&](int, V b0, V b1, V, V) HWY_ATTR { re = b0, im = b1; },
        [&](int l, int m, V p, V) HWY_ATTR {
          if (!in_patch_basis(l, m)) return;
          double* const row = rows + (1 + patch_index(l, m)) * n + i;
          hn::StoreU(hn::Mul(p, re), d, row);
          if (m > 0) hn::StoreU(hn::Mul(p, im), d, row + n);
        });
  }
}

void Gram(const double* rows, std::size_t count, const double* weights, std::size_t n,
          double* matrix) {
  const D d;
  for (std::size_t i = 0; i < count; i += 4) {
    for (std::size_t j = 0; j <= i; j += 4) {
      V sum[4][4];
      for (auto& row : sum) {
        for (V& v : row) v = hn::Zero(d);
      }
      for (std::size_t k = 0; k < n; k += hn::Lanes(d)) {
        const V weight = hn::LoadU(d, weights + k);
        V left[4], right[4];
        for (std::size_t r = 0; r < 4; ++r) {
          left[r] = hn::Mul(weight, hn::LoadU(d, rows + (i + r) * n + k));
          right[r] = hn::LoadU(d, rows + (j + r) * n + k);
        }
        for (std::size_t r = 0; r < 4; ++r) {
          for (std::size_t c = 0; c < 4; ++c) sum[r][c] = hn::MulAdd(left[r], right[c], sum[r][c]);
        }
      }
      for (std::size_t r = 0; r < 4 && i + r < count; ++r) {
        for (std::size_t c = 0; c < 4 && j + c < count; ++c) {
          matrix[(i + r) * count + j + c] = hn::GetLane(hn::SumOfLanes(d, sum[r][c]));
        }
      }
    }
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

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {
HWY_EXPORT(Rows);
HWY_EXPORT(Gram);
HWY_EXPORT(Sum);
}  // namespace

void patch_rows(const CapFrame& frame, int degree, const double* offsets, std::size_t n,
                double* rows, double* area) {
  HWY_DYNAMIC_DISPATCH(Rows)(frame, degree, offsets, n, rows, area);
}

void patch_gram(const double* rows, std::size_t count, const double* weights, std::size_t n,
                double* matrix) {
  HWY_DYNAMIC_DISPATCH(Gram)(rows, count, weights, n, matrix);
}

void patch_sum(const double* rows, const double* coefficients, std::size_t count, std::size_t n,
               double* out) {
  HWY_DYNAMIC_DISPATCH(Sum)(rows, coefficients, count, n, out);
}

}  // namespace rholm
#endif
