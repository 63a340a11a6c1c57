#include "harmonic/rings/ring_sums.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "harmonic/legendre/legendre_kernels.h"
#include "harmonic/rings/ring_kernels.h"

namespace rholm {

static_assert(kRingBlock == kLegendreLanes);

namespace {

// The rings of a block are far apart if some sin theta and some cos theta are below this. In other
// blocks, factors of a step lose at most a bit if formed from the larger of x^2 and s^2.
constexpr double kWide = 0.5;

// The functions below convert between sums or factors [4j ...] of the steps and coefficients of the
// degrees m + 2j and m + 2j + 1. The last step has no odd degree if ends_even().
bool ends_even(const RingOrder& order) { return (order.degree - order.m) % 2 == 0; }

// c_k += alpha_j eps_{k+1} sum_j + alpha_{j-1} eps_k sum_{j-1},   c_{k+1} += alpha_j sum_j
void from_lambda(const RingOrder& order, const double* sums, double* c, double* s) {
  const std::size_t n = order.n_steps(), n_odd = ends_even(order) ? n - 1 : n;
  double re = 0, im = 0;  // terms of the step before
  for (std::size_t j = 0; j < n; ++j) {
    const double even = order.alpha[j] * order.eps_odd[j];
    const double next = order.alpha[j] * order.eps_even[j];
    c[2 * j] += even * sums[4 * j] + re;
    s[2 * j] += even * sums[4 * j + 1] + im;
    re = next * sums[4 * j];
    im = next * sums[4 * j + 1];
  }
  for (std::size_t j = 0; j < n_odd; ++j) {
    c[2 * j + 1] += order.alpha[j] * sums[4 * j + 2];
    s[2 * j + 1] += order.alpha[j] * sums[4 * j + 3];
  }
}

// c_k += beta_j eps_{k+1} sum_j,   c_{k+1} += beta_j sum_j
void from_single(const RingOrder& order, const double* sums, double* c, double* s) {
  const std::size_t n = order.n_steps(), n_odd = ends_even(order) ? n - 1 : n;
  for (std::size_t j = 0; j < n; ++j) {
    const double even = order.beta[j] * order.eps_odd[j];
    c[2 * j] += even * sums[4 * j];
    s[2 * j] += even * sums[4 * j + 1];
  }
  for (std::size_t j = 0; j < n_odd; ++j) {
    c[2 * j + 1] += order.beta[j] * sums[4 * j + 2];
    s[2 * j + 1] += order.beta[j] * sums[4 * j + 3];
  }
}

// Does the transpose of from_lambda().
void to_lambda(const RingOrder& order, const double* c, const double* s, double* factors) {
  const std::size_t n = order.n_steps();
  for (std::size_t j = 0; j + 1 < n; ++j) {
    const double alpha = order.alpha[j];
    const double even = alpha * order.eps_odd[j], next = alpha * order.eps_even[j];
    factors[4 * j] = even * c[2 * j] + next * c[2 * j + 2];
    factors[4 * j + 1] = even * s[2 * j] + next * s[2 * j + 2];
    factors[4 * j + 2] = alpha * c[2 * j + 1];
    factors[4 * j + 3] = alpha * s[2 * j + 1];
  }
  const std::size_t j = n - 1;
  const double alpha = order.alpha[j], even = alpha * order.eps_odd[j];
  const bool no_odd = ends_even(order);
  factors[4 * j] = even * c[2 * j];
  factors[4 * j + 1] = even * s[2 * j];
  factors[4 * j + 2] = no_odd ? 0 : alpha * c[2 * j + 1];
  factors[4 * j + 3] = no_odd ? 0 : alpha * s[2 * j + 1];
}

// Does the transpose of from_single().
void to_single(const RingOrder& order, const double* c, const double* s, double* factors) {
  const std::size_t n = order.n_steps();
  for (std::size_t j = 0; j < n; ++j) {
    const bool no_odd = j + 1 == n && ends_even(order);
    const double beta = order.beta[j], even = beta * order.eps_odd[j];
    factors[4 * j] = even * c[2 * j];
    factors[4 * j + 1] = even * s[2 * j];
    factors[4 * j + 2] = no_odd ? 0 : beta * c[2 * j + 1];
    factors[4 * j + 3] = no_odd ? 0 : beta * s[2 * j + 1];
  }
}

// Calls visit(first ring) for each kDirect block, whose sums are formed for single degrees.
template <typename Visit>
void visit_direct_blocks(const RingOrder& order, const HalfRings& rings, const Visit& visit) {
  for (std::size_t block = 0; block * kRingBlock < rings.padded; ++block) {
    if (step_kind(order, rings, block) == StepKind::kDirect) visit(block * kRingBlock);
  }
}

void add_direct_adjoint(const RingOrder& order, const HalfRings& rings, const double* const* parts,
                        double* c, double* s) {
  visit_direct_blocks(order, rings, [&](std::size_t at) {
    const LegendreOrder single = legendre_order(order.m, order.degree, order.mu);
    const std::size_t rows = static_cast<std::size_t>(order.degree - order.m) + 1;
    for (std::size_t parity = 0; parity < 2; ++parity) {
      std::vector<double> re(rows, 0.0), im(rows, 0.0);
      legendre_adjoint(single, &rings.cos_theta[at], &rings.sin_theta[at], kRingBlock,
                       parts[2 * parity] + at, parts[2 * parity + 1] + at, re.data(), im.data());
      for (std::size_t l = parity; l < rows; l += 2) {
        c[l] += re[l];
        s[l] += im[l];
      }
    }
  });
}

void set_direct_forward(const RingOrder& order, const HalfRings& rings, const double* c,
                        const double* s, double* const* parts) {
  visit_direct_blocks(order, rings, [&](std::size_t at) {
    const LegendreOrder single = legendre_order(order.m, order.degree, order.mu);
    const std::size_t rows = static_cast<std::size_t>(order.degree - order.m) + 1;
    for (std::size_t parity = 0; parity < 2; ++parity) {
      std::vector<double> half_c(rows, 0.0), half_s(rows, 0.0);
      for (std::size_t l = parity; l < rows; l += 2) {
        half_c[l] = c[l];
        half_s[l] = s[l];
      }
      const double *c_row = half_c.data(), *s_row = half_s.data();
      double *re = parts[2 * parity] + at, *im = parts[2 * parity + 1] + at;
      legendre_forward(single, &rings.cos_theta[at], &rings.sin_theta[at], kRingBlock, 1, &c_row,
                       &s_row, &re, &im);
    }
  });
}

}  // namespace

StepKind step_kind(const RingOrder& order, const HalfRings& rings, std::size_t block) {
  const double s = rings.least_sin[block], x = rings.least_cos[block];
  const bool polar = s < order.polar_below, single = x < order.single_below;
  if (s < kWide && x < kWide) {
    // At a low degree, few blocks reach from pole to equator, and the two-degree step is accurate.
    return order.degree > 128 && (polar || single) ? StepKind::kDirect : StepKind::kEither;
  }
  return polar ? StepKind::kPolar : single ? StepKind::kSingle : StepKind::kLambda;
}

void ring_adjoint(const RingOrder& order, const HalfRings& rings, const double* even_re,
                  const double* even_im, const double* odd_re, const double* odd_im, double* c,
                  double* s) {
  const std::size_t n = order.n_steps();
  RingScratch sums(4 * (n + kStepPadding));
  const double* const parts[] = {even_re, even_im, odd_re, odd_im};
  if (ring_step_adjoint(order, rings, parts, false, sums.data())) {
    from_lambda(order, sums.data(), c, s);
  }
  if (order.single_below > 0 && ring_step_adjoint(order, rings, parts, true, sums.data())) {
    from_single(order, sums.data(), c, s);
  }
  add_direct_adjoint(order, rings, parts, c, s);
}

void ring_forward(const RingOrder& order, const HalfRings& rings, const double* c, const double* s,
                  double* even_re, double* even_im, double* odd_re, double* odd_im) {
  const std::size_t n = order.n_steps();
  RingScratch lambda(4 * n), single(4 * n);
  to_lambda(order, c, s, lambda.data());
  if (order.single_below > 0) to_single(order, c, s, single.data());
  double* const parts[] = {even_re, even_im, odd_re, odd_im};
  ring_step_forward(order, rings, lambda.data(), single.data(), parts);
  set_direct_forward(order, rings, c, s, parts);
}

}  // namespace rholm
