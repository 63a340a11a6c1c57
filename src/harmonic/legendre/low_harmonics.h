// Harmonics of low degree, all at once: constants of their recurrence.
//
// With u = (X, Y, Z) on the sphere, the real orthonormal harmonics are
//   p_lm(Z) Re (X + iY)^m  and  p_lm(Z) Im (X + iY)^m,
// p_lm polynomials: p_mm constant, p_lm = a_lm (Z p_{l-1,m} - b_lm p_{l-2,m}).
// Their order is that of atlas.h: l = 0, 1, ..., in each l m = 0, then cosine and sine of m = 1 ...
// l.
#pragma once

#include <array>
#include <cstddef>

namespace rholm {

inline constexpr int kMaxLowDegree = 24;  // beyond, transforms of scattered directions are for it

struct LowHarmonics {
  // By order m, then degree l >= m: p_mm at start[m]; a, b for l > m.
  std::array<double, kMaxLowDegree + 1> start;
  std::array<std::array<double, kMaxLowDegree + 1>, kMaxLowDegree + 1> a, b;
};
const LowHarmonics& low_harmonics();

// Those with l + m even alone, which are even in Z, up to twice that degree, where products of two
// end: p_{l+2,m} = (a_lm Z^2 - b_lm) p_lm - c_lm p_{l-2,m}.
inline constexpr int kMaxEvenDegree = 2 * kMaxLowDegree;
struct EvenHarmonics {
  std::array<double, kMaxEvenDegree + 1> start;
  std::array<std::array<double, kMaxEvenDegree + 1>, kMaxEvenDegree + 1> a, b, c;
};
const EvenHarmonics& even_harmonics();

// The place of the cosine of (l, m) among all harmonics; its sine is the next.
constexpr std::size_t low_index(int l, int m) {
  return static_cast<std::size_t>(l * l + (m == 0 ? 0 : 2 * m - 1));
}

// The same among those with l + m even.
constexpr std::size_t even_index(int l, int m) {
  return static_cast<std::size_t>(l * (l + 1) / 2 + (m == 0 ? 0 : m - 1));
}

// The coefficients of all harmonics up to a degree as those of powers of Z times Re and Im of
// (X + iY)^m, as many: orders m ascending, in each the powers degree - m ... 0, cosine before sine.
// They grow with (1 + sqrt 2)^degree and cancel in sums: for the lowest degrees.
inline constexpr int kMaxPowersDegree = 6;
void to_powers(int degree, const double* coefficients, double* powers);

}  // namespace rholm
