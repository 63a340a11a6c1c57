#include "atlas/cap/even_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "atlas/cap/even_moments.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "atlas/cap/cap_limits.h"
#include "base/poison.h"
#include "harmonic/legendre/low_harmonics-inl.h"
#include "rholm/harmonic.h"

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, kCapLanes>;
using V = hn::Vec<D>;

// Holds `kCount` vectors of points, so that sums are loaded and stored once for all of them.
template <std::size_t kCount>
using Several = std::array<V, kCount>;

template <std::size_t kCount>
HWY_INLINE void AddTo(D d, double* sum, const Several<kCount>& a, const Several<kCount>& b) {
  V v = hn::Load(d, sum);
  for (std::size_t g = 0; g < kCount; ++g) v = hn::MulAdd(a[g], b[g], v);
  hn::Store(v, d, sum);
}

// Adds the points from index i on to the lanes of Sum().
template <std::size_t kCount>
HWY_INLINE void SumSome(const EvenPoints& points, int degree, std::size_t i, double* lanes) {
  using Vs = Several<kCount>;
  const D d;
  const EvenHarmonics& h = even_harmonics();
  const std::size_t n = hn::Lanes(d), moments = even_index(2 * degree + 1, 0);
  double* const square = lanes + (moments + even_index(degree + 1, 0)) * n;
  Vs weight2, value, slope1, slope2, lean, fall, x, y, z2, re, im, re_below, im_below;
  for (std::size_t g = 0; g < kCount; ++g) {
    const auto row = [&](EvenPoints::Row which)
                         HWY_ATTR { return hn::Load(d, points.row(which) + i + g * n); };
    const V weight = row(EvenPoints::kWeight), z = row(EvenPoints::kZ);
    const V slope_weight = hn::Mul(weight, hn::Set(d, points.gradient_weight));
    value[g] = row(EvenPoints::kValue);
    slope1[g] = row(EvenPoints::kSlope1), slope2[g] = row(EvenPoints::kSlope2);
    const V squares = hn::MulAdd(value[g], value[g],
                                 hn::MulAdd(slope1[g], slope1[g], hn::Mul(slope2[g], slope2[g])));
    hn::Store(hn::Add(hn::Load(d, square), squares), d, square);
    weight2[g] = hn::Mul(weight, weight), value[g] = hn::Mul(weight, value[g]);
    slope1[g] = hn::Mul(slope_weight, slope1[g]), slope2[g] = hn::Mul(slope_weight, slope2[g]);
    lean[g] = hn::MulAdd(row(EvenPoints::kS1), slope1[g], hn::Mul(row(EvenPoints::kS2), slope2[g]));
    fall[g] = hn::Mul(hn::Neg(lean[g]), hn::Mul(hn::Add(z, z), hn::Add(z, hn::Set(d, 1.0))));
    x[g] = row(EvenPoints::kX), y[g] = row(EvenPoints::kY), z2[g] = hn::Mul(z, z);
    re[g] = hn::Set(d, 1.0), im[g] = re_below[g] = im_below[g] = hn::Zero(d);
  }
  for (int m = 0; m <= 2 * degree; ++m) {
    // Factors of p; in the right-hand side, factors of p and its derivative.
    Vs cosine, sine, right_cosine, right_sine, fall_cosine, fall_sine, p0, p1, d0, d1;
    const V order = hn::Set(d, static_cast<double>(m));
    for (std::size_t g = 0; g < kCount; ++g) {
      cosine[g] = hn::Mul(weight2[g], re[g]), sine[g] = hn::Mul(weight2[g], im[g]);
      const V both = hn::NegMulAdd(order, lean[g], value[g]);
      const V along1 = hn::Mul(order, slope1[g]), along2 = hn::Mul(order, slope2[g]);
      right_cosine[g] =
          hn::MulAdd(both, re[g], hn::MulSub(along1, re_below[g], hn::Mul(along2, im_below[g])));
      right_sine[g] =
          hn::MulAdd(both, im[g], hn::MulAdd(along1, im_below[g], hn::Mul(along2, re_below[g])));
      fall_cosine[g] = hn::Mul(fall[g], re[g]), fall_sine[g] = hn::Mul(fall[g], im[g]);
      p1[g] = hn::Set(d, h.start[m]), p0[g] = d0[g] = d1[g] = hn::Zero(d);
    }
    for (int l = m; l <= 2 * degree; l += 2) {
      double* const moment = lanes + even_index(l, m) * n;
      AddTo<kCount>(d, moment, p1, cosine);
      if (m > 0) AddTo<kCount>(d, moment + n, p1, sine);
      const V a = hn::Set(d, h.a[m][l]), b = hn::Set(d, h.b[m][l]), c = hn::Set(d, h.c[m][l]);
      if (l <= degree) {
        double* const right = moment + moments * n;
        AddTo<kCount>(d, right, p1, right_cosine);
        AddTo<kCount>(d, right, d1, fall_cosine);
        if (m > 0) AddTo<kCount>(d, right + n, p1, right_sine);
        if (m > 0) AddTo<kCount>(d, right + n, d1, fall_sine);
        for (std::size_t g = 0; g < kCount; ++g) {
          const V times = hn::MulSub(a, z2[g], b);
          const V next = hn::MulAdd(a, p1[g], hn::MulSub(times, d1[g], hn::Mul(c, d0[g])));
          d0[g] = d1[g], d1[g] = next;
        }
      }
      for (std::size_t g = 0; g < kCount; ++g) {
        const V next = hn::MulSub(hn::MulSub(a, z2[g], b), p1[g], hn::Mul(c, p0[g]));
        p0[g] = p1[g], p1[g] = next;
      }
    }
    for (std::size_t g = 0; g < kCount; ++g) {
      re_below[g] = re[g], im_below[g] = im[g];
      re[g] = hn::MulSub(x[g], re_below[g], hn::Mul(y[g], im_below[g]));
      im[g] = hn::MulAdd(x[g], im_below[g], hn::Mul(y[g], re_below[g]));
    }
  }
}

// Computes sum w^2 Y_lm up to twice the degree. Then the harmonics' rows times the right-hand side
// (slopes of low_harmonics-inl.h), and the right-hand side times itself. Each sum is first kept in
// the lanes of a vector.
void Sum(const EvenPoints& points, int degree, double* lanes, double* sums) {
  const D d;
  const std::size_t n = hn::Lanes(d);
  const std::size_t all = even_index(2 * degree + 1, 0) + even_index(degree + 1, 0) + 1;
  for (std::size_t k = 0; k < all * n; k += n) hn::Store(hn::Zero(d), d, lanes + k);
  std::size_t i = 0;
  for (; i + 2 * n <= points.length; i += 2 * n) SumSome<2>(points, degree, i, lanes);
  for (; i < points.length; i += n) SumSome<1>(points, degree, i, lanes);
  for (std::size_t k = 0; k < all; ++k) {
    sums[k] = hn::GetLane(hn::SumOfLanes(d, hn::Load(d, lanes + k * n)));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {
HWY_EXPORT(Sum);

// Returns the number of even harmonics up to a degree.
constexpr std::size_t n_even(int degree) { return even_index(degree + 1, 0); }

// A product of two harmonics has the orders m + m' and |m - m'|.
// Each order has the degrees lowest(), lowest() + 2, ... l + l'.
int lowest(int la, int lb, int order) { return std::max(std::abs(la - lb), order); }

// Visits all pairs (l, m), (l', m') of even harmonics with the
// second no later than the first; pairs of lower degrees come first.
template <class Visit>
void visit_pairs(int degree, const Visit& visit) {
  for (int la = 0; la <= degree; ++la) {
    for (int ma = la % 2; ma <= la; ma += 2) {
      for (int lb = 0; lb <= la; ++lb) {
        for (int mb = lb % 2; mb <= (lb < la ? lb : ma); mb += 2) visit(la, ma, lb, mb);
      }
    }
  }
}

// Computes p_a p_b (1 - Z^2)^((m + m')/2) as sums of p_lk (1 -
// Z^2)^(k/2), for both orders k of all pairs. Gauss's rule is exact here.
std::vector<double> make_products() {
  const EvenHarmonics& h = even_harmonics();
  const GaussRule rule = gauss_legendre(2 * kMaxLowDegree + 1);
  const std::size_t n = kMaxLowDegree + 1;  // northern nodes, with the equator last
  const auto values_of = [&](auto& values, int l, int m) { return &values[even_index(l, m) * n]; };
  std::vector<double> values(n_even(kMaxEvenDegree) * n), factors;
  for (int m = 0; m <= kMaxEvenDegree; ++m) {
    for (std::size_t q = 0; q < n; ++q) {
      const double z2 = rule.nodes[q] * rule.nodes[q];
      double below = 0, p = h.start[m] * std::pow(1 - z2, 0.5 * m);
      for (int l = m; l <= kMaxEvenDegree; l += 2) {
        values_of(values, l, m)[q] = p;
        const double next = (h.a[m][l] * z2 - h.b[m][l]) * p - h.c[m][l] * below;
        below = p, p = next;
      }
    }
  }
  std::vector<double> product(n);
  visit_pairs(kMaxLowDegree, [&](int la, int ma, int lb, int mb) {
    const double *const a = values_of(values, la, ma), *const b = values_of(values, lb, mb);
    for (const int k : {ma + mb, std::abs(ma - mb)}) {
      for (std::size_t q = 0; q < n; ++q) {
        const double nodes = q + 1 < n ? 2 : 1, around = (k == 0 ? 2 : 1) * std::numbers::pi;
        product[q] = nodes * around * rule.weights[q] * a[q] * b[q];
      }
      for (int l = lowest(la, lb, k); l <= la + lb; l += 2) {
        const double* const c = values_of(values, l, k);
        double sum = 0;
        for (std::size_t q = 0; q < n; ++q) sum += product[q] * c[q];
        factors.push_back(sum);
      }
    }
  });
  return factors;
}

const std::vector<double>& products() {
  static const std::vector<double> factors = make_products();
  return factors;
}

// Values l (l + 1).
constexpr std::array<double, kMaxEvenDegree + 1> kLaplacians = [] {
  std::array<double, kMaxEvenDegree + 1> all{};
  for (std::size_t l = 0; l < all.size(); ++l) all[l] = static_cast<double>(l * (l + 1));
  return all;
}();

struct OrderSum {
  double cosine = 0, sine = 0;
};

}  // namespace

void make_even_matrix(const EvenPoints& points, int degree, EvenMoments& scratch, double* matrix) {
  const std::size_t n = n_even(degree), moments = n_even(2 * degree), all = moments + n + 1;
  if (scratch.lanes.size() < all * kCapLanes) scratch.lanes = AlignedArray<double>(all * kCapLanes);
  poison_scratch(scratch.lanes.data(), all * kCapLanes * sizeof(double));
  scratch.sums.resize(all);
  double* const sums = scratch.sums.data();
  HWY_DYNAMIC_DISPATCH(Sum)(points, degree, scratch.lanes.data(), sums);
  matrix[0] = sums[moments + n];
  std::copy_n(sums + moments, n, matrix + 1);
  const double half = points.gradient_weight * points.gradient_weight / 2;
  const double* factor = products().data();
  visit_pairs(degree, [&](int la, int ma, int lb, int mb) {
    const double whole = 1 + half * (kLaplacians[la] + kLaplacians[lb]);
    const auto sum_of = [&](int k) {
      OrderSum sum;
      for (int l = lowest(la, lb, k); l <= la + lb; l += 2) {
        const double times = *factor++ * (whole - half * kLaplacians[l]);
        const double* const moment = sums + even_index(l, k);
        sum.cosine += times * moment[0];
        sum.sine += times * moment[1];
      }
      if (k == 0) sum.sine = 0;  // order 0 has no sine; the value read is another moment
      return sum;
    };
    // Uses cos a cos b = (cos(a + b) + cos(a - b)) / 2 and the like.
    const OrderSum sum = sum_of(ma + mb), difference = sum_of(std::abs(ma - mb));
    const double turned = ma < mb ? -difference.sine : difference.sine;
    double* const to = matrix + (1 + even_index(lb, mb)) * (n + 1) + 1 + even_index(la, ma);
    to[0] = (difference.cosine + sum.cosine) / 2;
    if (ma > 0) to[1] = (sum.sine + turned) / 2;
    if (mb == 0) return;
    double* const below = to + n + 1;
    below[0] = (sum.sine - turned) / 2;
    if (ma > 0) below[1] = (difference.cosine - sum.cosine) / 2;
  });
}

}  // namespace rholm
#endif
