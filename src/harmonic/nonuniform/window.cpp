#include "harmonic/nonuniform/window.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>
#include <vector>

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;

// I_0(x) = sum (x/2)^2k / k!^2: all terms are positive, so that no digits cancel.
template <typename R>
R bessel_i0(R x) {
  const R quarter = x * x / 4;
  R term = 1, sum = 1;
  for (int k = 1; term > std::numeric_limits<R>::epsilon() / 8 * sum; ++k) {
    term *= quarter / (static_cast<R>(k) * static_cast<R>(k));
    sum += term;
  }
  return sum;
}

// Fits polynomials through the values of functions at the n Chebyshev nodes.
template <typename R>
class ChebyshevFit {
 public:
  explicit ChebyshevFit(int n) : n_(n), cosines_(n * n) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const R angle = std::numbers::pi_v<R> * (static_cast<R>(j) + R(0.5)) / static_cast<R>(n);
        cosines_[j * n + k] = std::cos(static_cast<R>(k) * angle);
      }
    }
  }

  // Returns the coefficients of the powers of u.
  template <typename F>
  std::vector<R> powers(const F& f) const {
    std::vector<R> chebyshev(n_, R(0)), result(n_, R(0));
    for (int j = 0; j < n_; ++j) {
      const R value = f(cosines_[j * n_ + 1]);
      for (int k = 0; k < n_; ++k) {
        chebyshev[k] += R(k == 0 ? 1 : 2) / static_cast<R>(n_) * value * cosines_[j * n_ + k];
      }
    }
    // T_k in powers of u follows from T_{k+1} = 2 u T_k - T_{k-1}.
    std::vector<R> now(n_, R(0)), before(n_, R(0)), next(n_);
    now[0] = 1;
    for (int k = 0; k < n_; ++k) {
      for (int q = 0; q <= k; ++q) result[q] += chebyshev[k] * now[q];
      for (int q = 0; q < n_; ++q) {
        const R raised = q > 0 ? now[q - 1] : R(0);
        next[q] = k == 0 ? raised : 2 * raised - before[q];
      }
      before = now;
      now = next;
    }
    return result;
  }

 private:
  int n_;
  std::vector<R> cosines_;  // [node][k]
};

}  // namespace

double SpreadWindow::fourier(double k) const {
  const double omega = kPi * width * k / static_cast<double>(points);
  const double s = std::sqrt(beta * beta - omega * omega);
  return width * std::sinh(s) / (s * scale);
}

// The transform is large up to omega = beta. Setting this limit to the lowest alias, n - band, is
// ideal for sums with a white spectrum. A 1 % lower limit allows for the jump at the ends of the
// window (bench/window_bench with 1 in its place).
SpreadWindow spread_window(int width, std::size_t band, std::size_t points) {
  const double share = 1 - static_cast<double>(band) / static_cast<double>(points);
  const double beta = 0.99 * kPi * width * share;
  return {.width = width, .beta = beta, .points = points, .scale = bessel_i0(beta)};
}

int spread_terms(int width) {
  // A tap spans 2/w of the window, so that powers decay fast. With fewer terms, the error of values
  // or derivatives grows by more than a tenth (bench/window_bench, oversampling 1.25 ... 3).
  constexpr int kTerms[] = {4, 6, 6, 6, 8, 8, 10, 10, 10, 12, 12, 12, 14, 14};
  return kTerms[width - kMinSpreadWidth];
}

template <typename T>
SpreadTable<T> spread_table(const SpreadWindow& window) {
  SpreadTable<T> table;
  table.width = window.width;
  table.terms = spread_terms(window.width);
  // Powers lose digits, derivatives even more: the powers for double use extended precision.
  using R = std::conditional_t<sizeof(T) == sizeof(double), long double, double>;
  const R beta = window.beta, scale = bessel_i0(beta);
  const ChebyshevFit<R> fit(table.terms);
  const int taps = (window.width + 1) / 2;
  table.coefficients = AlignedArray<T>(static_cast<std::size_t>(3) * taps * table.terms);
  T* out = table.coefficients.data();
  std::vector<std::vector<R>> powers;
  powers.reserve(static_cast<std::size_t>(taps));
  for (int i = 0; i < taps; ++i) {
    powers.push_back(fit.powers([&](R u) {
      const R z = (static_cast<R>(2 * i + 1) + u) / static_cast<R>(window.width) - 1;
      return bessel_i0(beta * std::sqrt(std::max(R(0), 1 - z * z))) / scale;
    }));
  }
  for (int derivative = 0; derivative < 3; ++derivative) {
    for (std::vector<R>& p : powers) {
      for (const R c : p) *out++ = static_cast<T>(c);
      // The derivative is d/dx = -2 d/du.
      for (std::size_t q = 0; q + 1 < p.size(); ++q) p[q] = -2 * static_cast<R>(q + 1) * p[q + 1];
      p.back() = 0;
    }
  }
  return table;
}

template SpreadTable<float> spread_table(const SpreadWindow&);
template SpreadTable<double> spread_table(const SpreadWindow&);

}  // namespace rholm
