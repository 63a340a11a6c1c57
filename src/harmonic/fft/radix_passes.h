// Complex transforms by passes of radix 2, 3, 4, 5 and 8, in the order of Stockham: sorted in each
// pass, so that none is needed before or after. Layer: harmonic.
//
// A pass of radix R takes what is left to transform, n numbers in s interleaved sequences each, to
// R times as many sequences of m = n / R:
//   y[q + s (R p + k)] = w_n^(p k) sum_j x[q + s (p + m j)] w_R^(j k),  w_n = e^(-2 pi i / n),
// for p = 0 ... m - 1, k = 0 ... R - 1, q = 0 ... s - 1. The first has s = 1, the last m = 1.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "base/aligned_array.h"

namespace rholm {

struct RadixPass {
  std::size_t radix = 1, m = 1, s = 1;
  std::size_t twiddles = 0;  // where they begin

  // The factors w_n^(p k), k = 1 ... R - 1: of a pass with s = 1 or 4, whose vectors may go along
  // p, one array for the real and one for the imaginary parts of each k, every factor s times; of
  // others both parts of all k for each p.
  bool is_along_p() const { return s == 1 || s == 4; }
  std::size_t copies() const { return is_along_p() ? s : 1; }
  std::size_t twiddle(std::size_t p, std::size_t k) const {
    return is_along_p() ? s * (2 * m * (k - 1) + p) : 2 * (p * (radix - 1) + k - 1);
  }
  std::size_t imaginary() const { return is_along_p() ? s * m : 1; }  // from the real part
};

// The passes of a length and their twiddle factors.
template <typename T>
struct RadixPlan {
  std::vector<RadixPass> passes;
  AlignedArray<T> twiddles;
};

// Whether n >= 1 has no other prime factors than 2, 3 and 5.
bool is_radix_length(std::size_t n);
template <typename T>
RadixPlan<T> make_radix_plan(std::size_t n);

// X_k = sum_j x_j e^{-2 pi i jk/n}; both arrays hold n numbers, `in` is destroyed.
template <typename T>
void run_radix_plan(const RadixPlan<T>& plan, std::complex<T>* in, std::complex<T>* out);

}  // namespace rholm
