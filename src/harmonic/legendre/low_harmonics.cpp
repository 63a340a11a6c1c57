#include "harmonic/legendre/low_harmonics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rholm {
namespace {

template <std::size_t kCount>
void set_starts(std::array<double, kCount>& start) {
  start[0] = std::sqrt(0.25 / std::numbers::pi);
  for (std::size_t m = 1; m < kCount; ++m) {
    // The ratio is (2m+1)/(2m), and twice this at m = 1, where cosine and sine split e^{im phi}.
    const double twice = 2 * static_cast<double>(m);
    start[m] = start[m - 1] * std::sqrt((m == 1 ? 2.0 : 1.0) * (twice + 1) / twice);
  }
}

LowHarmonics make() {
  LowHarmonics h{};
  set_starts(h.start);
  for (int m = 0; m <= kMaxLowDegree; ++m) {
    for (int l = m + 1; l <= kMaxLowDegree; ++l) {
      const double ll = l, mm = m, k = l - 1;
      h.a[m][l] = std::sqrt((4 * ll * ll - 1) / (ll * ll - mm * mm));
      h.b[m][l] = std::sqrt((k * k - mm * mm) / (4 * k * k - 1));
    }
  }
  return h;
}

// Applies Z p_l = beta_{l+1} p_{l+1} + beta_l p_{l-1} twice.
EvenHarmonics make_even() {
  EvenHarmonics h{};
  set_starts(h.start);
  for (int m = 0; m <= kMaxEvenDegree; ++m) {
    const auto beta = [m](int l) {
      const double ll = l, mm = m;
      return l > m ? std::sqrt((ll * ll - mm * mm) / (4 * ll * ll - 1)) : 0;
    };
    for (int l = m; l + 2 <= kMaxEvenDegree; l += 2) {
      const double up = beta(l + 1), here = beta(l), scale = 1 / (up * beta(l + 2));
      h.a[m][l] = scale, h.b[m][l] = scale * (up * up + here * here);
      h.c[m][l] = scale * here * beta(l - 1);
    }
  }
  return h;
}

// p_lm as coefficients of powers of Z, [m][l][power]; every second coefficient is zero.
using PowersOfZ =
    std::array<std::array<std::array<double, kMaxPowersDegree + 1>, kMaxPowersDegree + 1>,
               kMaxPowersDegree + 1>;

PowersOfZ make_powers() {
  const LowHarmonics& h = low_harmonics();
  PowersOfZ p{};
  for (int m = 0; m <= kMaxPowersDegree; ++m) {
    p[m][m][0] = h.start[m];
    for (int l = m + 1; l <= kMaxPowersDegree; ++l) {
      for (int k = 0; k <= l - m; ++k) {
        const double above = k > 0 ? p[m][l - 1][k - 1] : 0, below = l > 1 ? p[m][l - 2][k] : 0;
        p[m][l][k] = h.a[m][l] * (above - h.b[m][l] * below);
      }
    }
  }
  return p;
}

}  // namespace

const EvenHarmonics& even_harmonics() {
  static const EvenHarmonics harmonics = make_even();
  return harmonics;
}

const LowHarmonics& low_harmonics() {
  static const LowHarmonics harmonics = make();
  return harmonics;
}

void to_powers(int degree, const double* coefficients, double* powers) {
  static const PowersOfZ all = make_powers();
  std::fill_n(powers, low_index(degree + 1, 0), 0.0);
  for (int m = 0; m <= degree; ++m) {
    const std::ptrdiff_t width = m == 0 ? 1 : 2, n = degree - m;
    for (int l = m; l <= degree; ++l) {
      const double* const c = coefficients + low_index(l, m);
      for (int k = l - m; k >= 0; k -= 2) {
        double* const to = powers + width * (n - k);
        for (std::ptrdiff_t i = 0; i < width; ++i) to[i] += all[m][l][k] * c[i];
      }
    }
    powers += width * (n + 1);
  }
}

}  // namespace rholm
