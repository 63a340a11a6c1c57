#include "harmonic/spread_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;

// I_0(x) = sum (x/2)^2k / k!^2: all terms positive, so nothing is lost.
double bessel_i0(double x) {
  const double quarter = x * x / 4;
  double term = 1, sum = 1;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    term *= quarter / (static_cast<double>(k) * k);
    sum += term;
  }
  return sum;
}

double window_value(const SpreadWindow& window, double z) {
  return bessel_i0(window.beta * std::sqrt(std::max(0.0, 1 - z * z))) / window.scale;
}

// Coefficients in powers of u of the polynomial through f at the Chebyshev nodes of degree p.
template <typename F>
std::vector<double> fit(int p, const F& f) {
  const int n = p + 1;
  std::vector<double> chebyshev(n, 0.0);
  for (int j = 0; j < n; ++j) {
    const double angle = kPi * (j + 0.5) / n;
    const double value = f(std::cos(angle));
    for (int k = 0; k < n; ++k)
      chebyshev[k] += (k == 0 ? 1.0 : 2.0) / n * value * std::cos(k * angle);
  }
  // T_k in powers of u: T_{k+1} = 2 u T_k - T_{k-1}.
  std::vector<double> powers(n, 0.0), now(n, 0.0), before(n, 0.0), next(n);
  now[0] = 1;
  for (int k = 0; k < n; ++k) {
    for (int q = 0; q <= k; ++q) powers[q] += chebyshev[k] * now[q];
    for (int q = 0; q < n; ++q) {
      next[q] = (k == 0 ? 1.0 : 2.0) * (q > 0 ? now[q - 1] : 0.0) - (k == 0 ? 0.0 : before[q]);
    }
    before = now;
    now = next;
  }
  return powers;
}

}  // namespace

double SpreadWindow::fourier(double k) const {
  const double omega = kPi * width * k / static_cast<double>(points);
  const double s = std::sqrt(beta * beta - omega * omega);
  return width * std::sinh(s) / (s * scale);
}

// The transform is large up to omega = beta: set to the lowest alias, n - band, it would be ideal
// for white sums; 1 % less gives a little to the jump at the window's ends (measured).
SpreadWindow spread_window(int width, std::size_t band, std::size_t points) {
  const double share = 1 - static_cast<double>(band) / static_cast<double>(points);
  const double beta = 0.99 * kPi * width * share;
  return {.width = width, .beta = beta, .points = points, .scale = bessel_i0(beta)};
}

// The rate is that of the header; the factor was measured on random sources and weights: 1.3 at
// sigma = 1.25, 1.9 at 1.5, 3 at 2, 4.7 at 2.8, within 30 % for widths 3 ... 16.
double spread_error(int width, double sigma) {
  return (2.1 * sigma - 1.2) * std::exp(-kPi * width * std::sqrt(1 - 1 / sigma));
}

double oversampling_for(int width, double error) {
  double low = 1, high = 8;
  if (spread_error(width, high) > error) return std::numeric_limits<double>::infinity();
  for (int step = 0; step < 40; ++step) {
    const double middle = (low + high) / 2;
    (spread_error(width, middle) > error ? low : high) = middle;
  }
  return high;
}

int spread_terms(int width) {
  // A tap spans 2/w of the window, so that powers fall fast. Measured, for oversampling 1.25 ... 3:
  // fewer would add more than a tenth to the error of values or derivatives.
  constexpr int kTerms[] = {4, 6, 6, 6, 8, 8, 10, 10, 10, 12, 12, 12, 14, 14};
  return kTerms[width - kMinSpreadWidth];
}

template <typename T>
SpreadTable<T> spread_table(const SpreadWindow& window) {
  SpreadTable<T> table;
  table.width = window.width;
  table.terms = spread_terms(window.width);
  const int taps = (window.width + 1) / 2;
  table.coefficients = AlignedArray<T>(static_cast<std::size_t>(3) * taps * table.terms);
  T* out = table.coefficients.data();
  std::vector<std::vector<double>> powers(taps);
  for (int i = 0; i < taps; ++i) {
    powers[i] = fit(table.terms - 1, [&](double u) {
      return window_value(window, (2 * i + 1 + u) / window.width - 1);
    });
  }
  for (int derivative = 0; derivative < 3; ++derivative) {
    for (std::vector<double>& p : powers) {
      for (const double c : p) *out++ = static_cast<T>(c);
      // d/dx = -2 d/du.
      for (std::size_t q = 0; q + 1 < p.size(); ++q) {
        p[q] = -2 * static_cast<double>(q + 1) * p[q + 1];
      }
      p.back() = 0;
    }
  }
  return table;
}

template SpreadTable<float> spread_table(const SpreadWindow&);
template SpreadTable<double> spread_table(const SpreadWindow&);

}  // namespace rholm
