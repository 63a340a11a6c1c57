// Gauss's rule by Newton's method on P_n(cos theta) in theta itself, with the recurrence in
// differences of legendre_kernels.h for m = 0. With t = 1 - cos theta = 2 sin^2(theta/2),
//   (l+1) (P_{l+1} - P_l) = l (P_l - P_{l-1}) - (2l+1) t P_l,
//   dP_n/dtheta = n (P_n - P_{n-1} - t P_n) / sin theta,   w = 2 / (dP_n/dtheta)^2.
#include "harmonic/rings/ring_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "harmonic/fft/fft.h"

namespace rholm {
namespace {

constexpr std::size_t kBatch = 16;  // chosen: nodes at once, hides latency

struct Batch {
  std::array<double, kBatch> theta, value, slope;
};

// Sets value to P_n and slope to dP_n/dtheta.
void evaluate_batch(std::size_t n, Batch& batch) {
  std::array<double, kBatch> t, p, d;
  for (std::size_t i = 0; i < kBatch; ++i) {
    const double s = std::sin(batch.theta[i] / 2);
    t[i] = 2 * s * s;
  }
  p.fill(1);
  d.fill(0);
  for (std::size_t l = 0; l < n; ++l) {
    const double ll = static_cast<double>(l);
    const double of_d = ll / (ll + 1), of_p = (2 * ll + 1) / (ll + 1);
    for (std::size_t i = 0; i < kBatch; ++i) {
      d[i] = of_d * d[i] - of_p * t[i] * p[i];
      p[i] += d[i];
    }
  }
  for (std::size_t i = 0; i < kBatch; ++i) {
    batch.value[i] = p[i];
    batch.slope[i] = static_cast<double>(n) * (d[i] - t[i] * p[i]) / std::sin(batch.theta[i]);
  }
}

}  // namespace

RingRule gauss_ring_rule(std::size_t n) {
  RingRule rule{std::vector<double>(n), std::vector<double>(n)};
  const double size = static_cast<double>(n);
  for (std::size_t first = 0; 2 * first < n; first += kBatch) {
    Batch batch;
    for (std::size_t i = 0; i < kBatch; ++i) {
      // Tricomi's guess; angles beyond the equator are not used and repeat the last one.
      const double at = static_cast<double>(std::min(first + i, n / 2));
      const double theta = std::numbers::pi * (at + 0.75) / (size + 0.5);
      batch.theta[i] = theta + 1 / (8 * size * size * std::tan(theta));
    }
    // The error of the guess is O(n^-3) or, at the poles, 1 % of the spacing; each step doubles the
    // digits.
    for (int step = 0; step < 4; ++step) {
      evaluate_batch(n, batch);
      if (step == 3) break;  // the slope is stationary at a node
      for (std::size_t i = 0; i < kBatch; ++i) batch.theta[i] -= batch.value[i] / batch.slope[i];
    }
    for (std::size_t i = first; i < first + kBatch && 2 * i < n; ++i) {
      const bool equator = 2 * i + 1 == n;
      const double theta = equator ? std::numbers::pi / 2 : batch.theta[i - first];
      const double slope = batch.slope[i - first];
      rule.colatitudes[n - 1 - i] = std::numbers::pi - theta;
      rule.colatitudes[i] = theta;
      rule.weights[i] = rule.weights[n - 1 - i] = 2 / (slope * slope);
    }
  }
  return rule;
}

RingRule fejer_ring_rule(std::size_t n) {
  // Integrates the trigonometric polynomial of degree n - 1 through the values. The weights
  // are
  // w_i = (1/n) sum over even |k| < n of mu_k e^{i k theta_i}, where
  // mu_k = int cos(k theta) sin(theta) dtheta = 2 / (1 - k^2).
  const std::size_t circle = 2 * n;
  AlignedArray<std::complex<double>> in(circle), out(circle);
  std::fill(in.begin(), in.end(), 0.0);
  const double size = static_cast<double>(n);
  for (std::size_t k = 0; k < n; k += 2) {
    const double kk = static_cast<double>(k);
    const std::complex<double> term =
        std::polar(2 / ((1 - kk * kk) * size), -kk * std::numbers::pi / (2 * size));
    in[k] = term;
    if (k > 0) in[circle - k] = std::conj(term);
  }
  ComplexFft<double>(circle).forward(in.data(), out.data());
  RingRule rule{std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    rule.colatitudes[i] = (static_cast<double>(i) + 0.5) * std::numbers::pi / size;
    rule.weights[i] = out[i].real();
  }
  return rule;
}

}  // namespace rholm
