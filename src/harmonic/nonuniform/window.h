// The Kaiser-Bessel window of the nonuniform transform, on w grid points.
//
//   k(z) = I_0(beta sqrt(1 - z^2)) / I_0(beta), |z| <= 1, z = 2 (distance in grid steps) / w.
// Its Fourier transform is w sinh(s) / (s I_0(beta)), s = sqrt(beta^2 - (pi w k / n)^2).
// It is an entire function of z inside its support, so that polynomials approximate it and its
// derivatives equally well. Its aliasing decays like exp(-pi w sqrt(1 - 1/sigma)), sigma = n / (2
// L) (Jackson, Meyer, Nishimura, Macovski 1991; Barnett 2021 for the rate).
#pragma once

#include <cstddef>

#include "base/aligned_array.h"

namespace rholm {

inline constexpr int kMinSpreadWidth = 3;
inline constexpr int kMaxSpreadWidth = 16;

// Returns the length of a row of taps in memory: a whole number of vectors.
constexpr int padded_width(int width) { return width <= 4 ? 4 : width <= 8 ? 8 : 16; }

// The window for waves up to order `band` on n points per turn.
struct SpreadWindow {
  int width = 0;  // w
  double beta = 0;
  std::size_t points = 0;  // n
  double scale = 0;        // I_0(beta)

  // Returns the Fourier transform at wave number k <= band.
  double fourier(double k) const;
};
SpreadWindow spread_window(int width, std::size_t band, std::size_t points);

// The window as polynomials. Tap i = 0 ... w - 1 of a source at x is the grid point c0 + i, where
// c0 = ceil(x). Its distance from x is c0 + i - w/2 - x, as grid point c has position c - w/2. With
// u = 2 (c0 - x) - 1 in [-1, 1],
//   k(tap i) = p_i(u) = sum_q c_iq u^q,   k(tap w - 1 - i) = p_i(-u).
// The derivatives by x in grid steps are -2 p_i'(u) and 4 p_i''(u) for tap i, and 2 p_i'(-u) and 4
// p_i''(-u) for tap w - 1 - i.
int spread_terms(int width);  // an even number, 4 ... kMaxSpreadTerms
inline constexpr int kMaxSpreadTerms = 14;
template <typename T>
struct SpreadTable {
  int width = 0;
  int terms = 0;                 // q = 0 ... terms - 1
  AlignedArray<T> coefficients;  // [3][(w + 1) / 2][terms]: derivatives 0, 1, 2
  const T* row(int derivative, int tap) const {
    return coefficients.data() +
           (static_cast<std::size_t>(derivative) * ((width + 1) / 2) + tap) * terms;
  }
};
template <typename T>
SpreadTable<T> spread_table(const SpreadWindow& window);

}  // namespace rholm
