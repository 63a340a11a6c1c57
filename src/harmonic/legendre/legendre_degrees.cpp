#include "harmonic/legendre/legendre_degrees.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harmonic/legendre/legendre_degrees.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "harmonic/legendre/legendre_block-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void AddByDegree(const LegendreOrder& order, const double* x, const double* sin_theta,
                 const double* cosine, const double* sine, size_t n, const double* c,
                 const double* s, double* sums) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  const int last = order.degree - order.m;
  for (size_t j = 0; j < n; j += kVectors * lanes) {
    Block b;
    start(d, order, x + j, sin_theta + j, b);
    double* at = sums + j;
    for (int row = 0;; ++row, at += n) {
      if (!b.scaled || any_visible(d, b)) {
        V values[kVectors];
        visible(d, b, values);
        const V cv = hn::Set(d, c[row]), sv = hn::Set(d, s[row]);
        for (int v = 0; v < kVectors; ++v) {
          const size_t k = static_cast<size_t>(v) * lanes;
          const V p = row & 1 ? hn::Xor(values[v], b.sign[v]) : values[v];
          const V wave =
              hn::MulAdd(cv, hn::LoadU(d, cosine + j + k), hn::Mul(sv, hn::LoadU(d, sine + j + k)));
          hn::StoreU(hn::MulAdd(wave, p, hn::LoadU(d, at + k)), d, at + k);
        }
      }
      if (row == last) break;
      advance(d, order, row, b);
      if (b.scaled) rescale(d, b);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(AddByDegree);

void add_by_degree(const LegendreOrder& order, const double* x, const double* sin_theta,
                   const double* cosine, const double* sine, std::size_t n, const double* c,
                   const double* s, double* sums) {
  HWY_DYNAMIC_DISPATCH(AddByDegree)(order, x, sin_theta, cosine, sine, n, c, s, sums);
}

}  // namespace rholm
#endif  // HWY_ONCE
