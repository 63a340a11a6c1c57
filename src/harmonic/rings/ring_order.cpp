#include "harmonic/rings/ring_order.h"

#include <algorithm>
#include <cmath>

#include "base/poison.h"
#include "harmonic/legendre/legendre_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "harmonic/rings/ring_order.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, 8>;
using V = hn::Vec<D>;

// Returns the numbers first, first + 2, ... of a table that is split by parity.
HWY_INLINE const double* from(const std::array<AlignedArray<double>, 2>& table, int first) {
  return table[first & 1].data() + first / 2;
}

void Eps(const RingTables& tables, RingOrder& order) {
  const D d;
  const int m = order.m;
  const double *root1 = from(tables.root, 1), *root2 = from(tables.root, 2);
  const double *more1 = from(tables.root, 2 * m + 1), *more2 = from(tables.root, 2 * m + 2);
  const double *inverse1 = from(tables.inverse_root, m + 1),
               *inverse2 = from(tables.inverse_root, m + 2);
  // The last alpha needs two more steps.
  for (size_t j = 0; j < order.n_steps() + 2; j += hn::Lanes(d)) {
    const V odd = hn::Mul(hn::LoadU(d, root1 + j), hn::LoadU(d, more1 + j));
    const V even = hn::Mul(hn::LoadU(d, root2 + j), hn::LoadU(d, more2 + j));
    hn::StoreU(hn::Mul(odd, hn::LoadU(d, inverse1 + j)), d, order.eps_odd.data() + j);
    hn::StoreU(hn::Mul(even, hn::LoadU(d, inverse2 + j)), d, order.eps_even.data() + j);
  }
}

void Factors(const RingTables& tables, RingOrder& order) {
  const D d;
  const double m = order.m;
  const V half = hn::Set(d, 0.5), excess = hn::Set(d, 2 * m * m - 0.5);
  const double* product = from(tables.inverse_product, order.m + 1);
  for (size_t j = 0; j < order.n_steps(); j += hn::Lanes(d)) {
    const V odd = hn::LoadU(d, order.eps_odd.data() + j);
    const V even = hn::LoadU(d, order.eps_even.data() + j);
    const V alpha = hn::LoadU(d, order.alpha.data() + j);
    const V a = hn::Mul(alpha, alpha), minus_a = hn::Neg(a);
    // 1 - eps_l^2 - eps_{l+1}^2, which loses digits if it is formed as a difference.
    const V rest = hn::MulAdd(excess, hn::LoadU(d, product + j), half);
    hn::StoreU(a, d, order.a.data() + j);
    hn::StoreU(minus_a, d, order.minus_a.data() + j);
    hn::StoreU(hn::Mul(minus_a, hn::MulAdd(odd, odd, hn::Mul(even, even))), d, order.b.data() + j);
    hn::StoreU(hn::Mul(a, rest), d, order.c.data() + j);
  }
}

void PolarFactors(const RingTables& tables, RingOrder& order) {
  const D d;
  const double* inverse = from(tables.inverse_root, order.m + 2);
  const V one = hn::Set(d, 1.0);
  order.inverse_rho[0] = 0;
  for (size_t j = 0; j < order.n_steps(); j += hn::Lanes(d)) {
    const double first = 2 * (order.m + static_cast<double>(j)) + 2;
    const V n = hn::MulAdd(hn::Iota(d, 0), hn::Set(d, 2.0), hn::Set(d, first));
    const V i = hn::LoadU(d, inverse + j);
    const V rho = hn::Mul(hn::Mul(hn::LoadU(d, order.a.data() + j), hn::Mul(i, i)),
                          hn::Mul(n, hn::Add(n, one)));
    hn::StoreU(rho, d, order.rho.data() + j);
    hn::StoreU(hn::Div(one, rho), d, order.inverse_rho.data() + j + 1);
  }
}

void EquatorialFactors(RingOrder& order) {
  const D d;
  const V one = hn::Set(d, 1.0);
  for (size_t j = 0; j < order.n_steps(); j += hn::Lanes(d)) {
    const V odd = hn::LoadU(d, order.eps_odd.data() + j);
    const V even = hn::LoadU(d, order.eps_even.data() + j);
    const V inverse = hn::Div(one, hn::Mul(even, even));
    hn::StoreU(inverse, d, order.of_r.data() + j);
    hn::StoreU(hn::Mul(hn::Mul(odd, odd), inverse), d, order.of_p.data() + j);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {
namespace {

HWY_EXPORT(Eps);
HWY_EXPORT(Factors);
HWY_EXPORT(PolarFactors);
HWY_EXPORT(EquatorialFactors);

constexpr std::size_t kPadding = 16;  // for vectors that reach beyond the end, and one more value

// e^-45 < 2^-64: half a unit in the last place of 1, over 2048 terms that may all be equal.
constexpr double kLogNegligible = 45;

// The two-degree step is not accurate enough where sin theta or cos theta is below these limits.
// They keep its errors near 1e-13 of the largest value. The errors were measured against 34 digits
// (by ring_sums_test against 19) for L = 64 ... 4096. Up to L = 128, the errors near the equator
// stay below that.
double polar_limit(int degree) { return 1.5e-3 * std::sqrt(degree); }
double single_limit(int degree) { return degree <= 128 ? 0 : 3e-4 * std::sqrt(degree); }

void make_room(std::size_t n, AlignedArray<double>& array) {
  if (array.size() < n + kPadding) {
    array = AlignedArray<double>(n + kPadding);
  } else {
    poison_scratch(array.data(), array.size() * sizeof(double));
  }
}

}  // namespace

RingTables::RingTables(int max_degree) : degree(max_degree), mu(legendre_mu(max_degree)) {
  const std::size_t n = static_cast<std::size_t>(degree) + 2 * kPadding;
  for (std::size_t parity = 0; parity < 2; ++parity) {
    for (auto* table : {&root, &inverse_root, &inverse_product}) {
      (*table)[parity] = AlignedArray<double>(n);
    }
    for (std::size_t i = 0; i < n; ++i) {
      const double k = static_cast<double>(2 * i + parity);
      root[parity][i] = std::sqrt(k);
      inverse_root[parity][i] = k > 0 ? 1 / std::sqrt(4 * k * k - 1) : 0;
      inverse_product[parity][i] = 1 / ((2 * k - 1) * (2 * k + 3));
    }
  }
}

void set_ring_order(const RingTables& tables, int m, RingOrder& order) {
  order.m = m;
  order.degree = tables.degree;
  order.mu = tables.mu[m];
  const double limit = polar_limit(order.degree);
  order.polar_below = stays_hidden(m, order.degree, limit) ? 0 : limit;
  order.single_below = single_limit(order.degree);
  const std::size_t n = order.n_steps();
  for (auto* array : {&order.eps_odd, &order.eps_even, &order.alpha, &order.a, &order.minus_a,
                      &order.b, &order.c}) {
    make_room(n, *array);
  }
  HWY_DYNAMIC_DISPATCH(Eps)(tables, order);
  // Every second alpha comes from a product, alpha_{j+2} = alpha_j g_j / g_{j+1}. A chain of
  // divisions would be slower, and rounding errors would separate two chains of products.
  const double *odd = order.eps_odd.data(), *even = order.eps_even.data();
  double alpha = 1 / odd[0];
  for (std::size_t j = 0; j < n; j += 2) {
    const double g = even[j] * odd[j + 1];
    order.alpha[j] = alpha;
    order.alpha[j + 1] = 1 / (g * alpha);
    alpha *= g / (even[j + 1] * odd[j + 2]);
  }
  HWY_DYNAMIC_DISPATCH(Factors)(tables, order);
  if (order.polar_below > 0) {
    for (auto* array : {&order.rho, &order.inverse_rho}) make_room(n, *array);
    HWY_DYNAMIC_DISPATCH(PolarFactors)(tables, order);
  }
  if (order.single_below > 0) {
    for (auto* array : {&order.of_r, &order.of_p, &order.beta}) make_room(n, *array);
    HWY_DYNAMIC_DISPATCH(EquatorialFactors)(order);
    double beta = 1 / odd[0];
    for (std::size_t j = 0; j < n; ++j) {
      order.beta[j] = beta;
      beta *= even[j] / odd[j + 1];
    }
  }
}

// Below the turning point s_0 = m / Lambda, Lambda = l + 1/2, Pt_lm decays as exp(-S) with
//   S = int sqrt(m^2 / sin^2 - Lambda^2) dtheta >= m (artanh w - w),   w^2 = 1 - (s / s_0)^2.
// This bound omits a factor 1 / cos theta >= 1, and artanh w - w >= w^3 / 3. It includes the step
// that goes beyond `degree`.
bool stays_hidden(int m, int degree, double s) {
  const double z = (degree + 2.0) * s;
  if (z >= m) return false;
  const double w = std::sqrt(1 - z * z / (static_cast<double>(m) * m));
  return m * w * w * w / 3 > kLogNegligible || m * (std::atanh(w) - w) > kLogNegligible;
}

}  // namespace rholm
#endif  // HWY_ONCE
