// The inner loops of sphere_fourier.h: between rows of the grid, great circles and rings, for
// kOrderBlock orders m at a time.
//
// Two orders, an even and an odd one, share a circle: their functions are even and odd in theta.
// Circles run backwards, index -row, so that forward Fourier transforms do for both signs.
#pragma once

#include <cstddef>

#include "base/aligned_array.h"
#include "harmonic/nonuniform/spread.h"

namespace rholm {

// In single precision one cache line of a row.
inline constexpr int kOrderBlock = 8;
inline constexpr int kPairs = kOrderBlock / 2;

// Adds for orders a, b of each pair a + b at the row's place on the circle and a - b at that of its
// mirror image theta -> -theta. `rows` begins at the first of the orders, complex numbers.
template <typename T>
void gather_circles(const GridLayout& layout, const T* rows, T* const* circles);

// The transpose: a = here + there, b = here - there.
template <typename T>
void scatter_circles(const GridLayout& layout, const T* const* circles, T* rows);

// Complex factors in the form (re, re), (-im, im).
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
// out[k] = factors[k] in[k], all k.
template <typename T>
void multiply(const Factors<T>& factors, const T* in, T* out);

// The rows of an order on rings of the northern half, as ring sums want them.
struct RingParts {
  double *even_re, *even_im, *odd_re, *odd_im;
};
// From a circle of 2 n complex numbers at theta = (q + 1/2) pi / n, n even, the parts of its even
// order and of its odd order on n/2 rings.
template <typename T>
void split_circle(const T* circle, std::size_t n, const RingParts& even, const RingParts& odd);
// The transpose; writes the whole circle.
template <typename T>
void join_circle(const RingParts& even, const RingParts& odd, std::size_t n, T* circle);

}  // namespace rholm
