// The inner loops of sphere_fourier.h between rows of the grid, great circles and rings, for
// kOrderBlock orders m at a time.
//
// An even and an odd order share a circle, because their functions are even and odd in theta. The
// index on a circle is -row, so that forward Fourier transforms serve both directions.
#pragma once

#include <cstddef>

#include "base/aligned_array.h"
#include "harmonic/nonuniform/spread.h"

namespace rholm {

// Number of orders whose values take one cache line of a row in single precision.
inline constexpr int kOrderBlock = 8;
inline constexpr int kPairs = kOrderBlock / 2;

// Adds the orders a, b of each pair: a + b at the row's index on the circle, a - b at the mirrored
// index (theta -> -theta). `rows` begins at the first order; numbers are complex.
template <typename T>
void gather_circles(const GridLayout& layout, const T* rows, T* const* circles);

// Does the transpose: a = here + there, b = here - there.
template <typename T>
void scatter_circles(const GridLayout& layout, const T* const* circles, T* rows);

// Complex factors, stored as (re, re) and (-im, im).
template <typename T>
struct Factors {
  explicit Factors(std::size_t n) : size(n), re(2 * n), im(2 * n) {}
  void set(std::size_t k, double real, double imaginary) {
    re[2 * k] = re[2 * k + 1] = static_cast<T>(real);
    im[2 * k + 1] = static_cast<T>(imaginary);
    im[2 * k] = -im[2 * k + 1];
  }
  std::size_t size;
  AlignedArray<T> re, im;
};
// Computes out[k] = factors[k] in[k] for all k.
template <typename T>
void multiply(const Factors<T>& factors, const T* in, T* out);

// The values of one order on the rings of the northern half, in the layout of the ring sums.
struct RingParts {
  double *even_re, *even_im, *odd_re, *odd_im;
};
// Splits a circle of 2 n complex numbers at theta = (q + 1/2) pi / n, n even. The results are the
// parts of its even order and of its odd order on n/2 rings.
template <typename T>
void split_circle(const T* circle, std::size_t n, const RingParts& even, const RingParts& odd);
// Does the transpose; writes the whole circle.
template <typename T>
void join_circle(const RingParts& even, const RingParts& odd, std::size_t n, T* circle);

}  // namespace rholm
