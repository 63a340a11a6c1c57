#include "harmonic/legendre/legendre_kernels.h"

#include <hwy/aligned_allocator.h>

#include <cmath>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harmonic/legendre/legendre_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "harmonic/legendre/legendre_block-inl.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

void Adjoint(const LegendreOrder& order, const double* x, const double* s, size_t n,
             const double* re, const double* im, double* c_out, double* s_out) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  const size_t rows = static_cast<size_t>(order.degree - order.m) + 1;
  // Sums stay apart by lane until the end, in the layout [row][cos, sin][lane].
  auto sums = hwy::AllocateAligned<double>(rows * 2 * lanes);
  for (size_t i = 0; i < rows * 2 * lanes; i += lanes) hn::Store(hn::Zero(d), d, sums.get() + i);
  for (size_t j = 0; j < n; j += kVectors * lanes) {
    Block b;
    start(d, order, x + j, s + j, b);
    V wr[kVectors], wi[kVectors];
    for (int v = 0; v < kVectors; ++v) {
      wr[v] = hn::LoadU(d, re + j + static_cast<size_t>(v) * lanes);
      wi[v] = hn::LoadU(d, im + j + static_cast<size_t>(v) * lanes);
    }
    double* row = sums.get();
    // Adds the values of one degree; they have the sign of x where l - m is odd.
    const auto add = [&](const V* values, bool odd) HWY_ATTR {
      V sum_c = hn::Load(d, row), sum_s = hn::Load(d, row + lanes);
      for (int v = 0; v < kVectors; ++v) {
        const V p = odd ? hn::Xor(values[v], b.sign[v]) : values[v];
        sum_c = hn::MulAdd(p, wr[v], sum_c);
        sum_s = hn::MulAdd(p, wi[v], sum_s);
      }
      hn::Store(sum_c, d, row);
      hn::Store(sum_s, d, row + lanes);
    };
    int l = order.m;
    while (b.scaled && l <= order.degree) {
      if (any_visible(d, b)) {
        V values[kVectors];
        visible(d, b, values);
        add(values, (l - order.m) & 1);
      }
      row += 2 * lanes;
      if (l++ == order.degree) break;
      advance(d, order, l - 1 - order.m, b);
      rescale(d, b);
    }
    if (l <= order.degree && ((l - order.m) & 1)) {
      add(b.p, true);
      row += 2 * lanes;
      if (l++ < order.degree) advance(d, order, l - 1 - order.m, b);
    }
    for (; l < order.degree; l += 2) {
      add(b.p, false);
      row += 2 * lanes;
      advance(d, order, l - order.m, b);
      add(b.p, true);
      row += 2 * lanes;
      if (l + 1 < order.degree) advance(d, order, l + 1 - order.m, b);
    }
    if (l == order.degree) add(b.p, false);
  }
  for (size_t row = 0; row < rows; ++row) {
    const double* at = sums.get() + row * 2 * lanes;
    c_out[row] += hn::GetLane(hn::SumOfLanes(d, hn::Load(d, at)));
    s_out[row] += hn::GetLane(hn::SumOfLanes(d, hn::Load(d, at + lanes)));
  }
}

template <int kSets>
void ForwardSets(const LegendreOrder& order, const double* x, const double* s, size_t n,
                 const double* const* c, const double* const* sn, double* const* re,
                 double* const* im) {
  const D d;
  const size_t lanes = hn::Lanes(d);
  for (size_t j = 0; j < n; j += kVectors * lanes) {
    Block b;
    start(d, order, x + j, s + j, b);
    // Sums over odd l - m are kept apart; they get the sign of x at the end.
    V sum_re[kSets][2][kVectors], sum_im[kSets][2][kVectors];
    for (int set = 0; set < kSets; ++set) {
      for (int v = 0; v < kVectors; ++v) {
        sum_re[set][0][v] = sum_re[set][1][v] = sum_im[set][0][v] = sum_im[set][1][v] = hn::Zero(d);
      }
    }
    const auto add = [&](const V* values, int row, int odd) HWY_ATTR {
      for (int set = 0; set < kSets; ++set) {
        const V cv = hn::Set(d, c[set][row]), sv = hn::Set(d, sn[set][row]);
        for (int v = 0; v < kVectors; ++v) {
          sum_re[set][odd][v] = hn::MulAdd(values[v], cv, sum_re[set][odd][v]);
          sum_im[set][odd][v] = hn::MulAdd(values[v], sv, sum_im[set][odd][v]);
        }
      }
    };
    const int last = order.degree - order.m;
    int row = 0;
    while (b.scaled && row <= last) {
      if (any_visible(d, b)) {
        V values[kVectors];
        visible(d, b, values);
        if (row & 1) {
          add(values, row, 1);
        } else {
          add(values, row, 0);
        }
      }
      if (row++ == last) break;
      advance(d, order, row - 1, b);
      rescale(d, b);
    }
    if (row <= last && (row & 1)) {
      add(b.p, row, 1);
      if (row++ < last) advance(d, order, row - 1, b);
    }
    for (; row < last; row += 2) {
      add(b.p, row, 0);
      advance(d, order, row, b);
      add(b.p, row + 1, 1);
      if (row + 1 < last) advance(d, order, row + 1, b);
    }
    if (row == last) add(b.p, row, 0);
    for (int set = 0; set < kSets; ++set) {
      for (int v = 0; v < kVectors; ++v) {
        const size_t at = j + static_cast<size_t>(v) * lanes;
        hn::StoreU(hn::Add(hn::Xor(sum_re[set][1][v], b.sign[v]), sum_re[set][0][v]), d,
                   re[set] + at);
        hn::StoreU(hn::Add(hn::Xor(sum_im[set][1][v], b.sign[v]), sum_im[set][0][v]), d,
                   im[set] + at);
      }
    }
  }
}

void Forward(const LegendreOrder& order, const double* x, const double* s, size_t n, int n_sets,
             const double* const* c, const double* const* sn, double* const* re,
             double* const* im) {
  if (n_sets == 1) {
    ForwardSets<1>(order, x, s, n, c, sn, re, im);
  } else {
    ForwardSets<4>(order, x, s, n, c, sn, re, im);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(Adjoint);
HWY_EXPORT(Forward);

void legendre_adjoint(const LegendreOrder& order, const double* x, const double* s, std::size_t n,
                      const double* re, const double* im, double* c_out, double* s_out) {
  HWY_DYNAMIC_DISPATCH(Adjoint)(order, x, s, n, re, im, c_out, s_out);
}

void legendre_forward(const LegendreOrder& order, const double* x, const double* s, std::size_t n,
                      int n_sets, const double* const* c, const double* const* sn,
                      double* const* re, double* const* im) {
  HWY_DYNAMIC_DISPATCH(Forward)(order, x, s, n, n_sets, c, sn, re, im);
}

std::vector<double> legendre_row(const LegendreOrder& order, double x, double s) {
  const std::size_t rows = static_cast<std::size_t>(order.degree - order.m) + 1;
  std::vector<double> xs(kLegendreLanes, 0.0), ss(kLegendreLanes, 1.0), w(kLegendreLanes, 0.0);
  const std::vector<double> zero(kLegendreLanes, 0.0);
  std::vector<double> row(rows, 0.0), unused(rows, 0.0);
  xs[0] = x;
  ss[0] = s;
  w[0] = 1;
  legendre_adjoint(order, xs.data(), ss.data(), kLegendreLanes, w.data(), zero.data(), row.data(),
                   unused.data());
  return row;
}

}  // namespace rholm
#endif  // HWY_ONCE
