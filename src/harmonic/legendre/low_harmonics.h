// All harmonics of low degree at once: the constants of their recurrence.
//
// With u = (X, Y, Z) on the sphere, the real orthonormal harmonics are
//   p_lm(Z) Re (X + iY)^m  and  p_lm(Z) Im (X + iY)^m.
// Polynomials p_lm begin with a constant p_mm: p_lm = a_lm (Z p_{l-1,m} - b_lm p_{l-2,m}).
// The order is as in atlas.h: l = 0, 1, ...; for each l first m = 0, then cosine and sine of m = 1,
// 2, ..., l.
#pragma once

#include <array>
#include <cstddef>

namespace rholm {

inline constexpr int kMaxLowDegree = 24;  // above, use the scattered transforms

struct LowHarmonics {
  // Indexed by order m, then degree l >= m: start[m] is p_mm; a and b are for l > m.
  std::array<double, kMaxLowDegree + 1> start;
  std::array<std::array<double, kMaxLowDegree + 1>, kMaxLowDegree + 1> a, b;
};
const LowHarmonics& low_harmonics();

// Recurrence for even l + m, where p_lm is even in Z: p_{l+2,m} = (a_lm Z^2 - b_lm) p_lm - c_lm
// p_{l-2,m}. Degrees go up to twice kMaxLowDegree, the degree of products of two.
inline constexpr int kMaxEvenDegree = 2 * kMaxLowDegree;
struct EvenHarmonics {
  std::array<double, kMaxEvenDegree + 1> start;
  std::array<std::array<double, kMaxEvenDegree + 1>, kMaxEvenDegree + 1> a, b, c;
};
const EvenHarmonics& even_harmonics();

// Returns the index of the cosine of (l, m) among all harmonics; its sine comes next.
constexpr std::size_t low_index(int l, int m) {
  return static_cast<std::size_t>(l * l + (m == 0 ? 0 : 2 * m - 1));
}

// Returns the index of the cosine of (l, m) among the harmonics with even l + m.
constexpr std::size_t even_index(int l, int m) {
  return static_cast<std::size_t>(l * (l + 1) / 2 + (m == 0 ? 0 : m - 1));
}

// Converts coefficients of all harmonics up to `degree` to as many coefficients of powers of Z
// times Re and Im of (X + iY)^m. Orders m ascend, with powers degree - m ... 0 each, cosine first.
// Coefficients grow with (1 + sqrt 2)^degree and cancel in sums: only for the lowest degrees.
inline constexpr int kMaxPowersDegree = 6;
void to_powers(int degree, const double* coefficients, double* powers);

}  // namespace rholm
