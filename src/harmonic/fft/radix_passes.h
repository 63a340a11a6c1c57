// Complex transforms by passes of radix 2, 3, 4, 5 and 8, in the order of Stockham: each pass
// sorts, so that no sorting is needed before or after. Layer: harmonic.
//
// A pass of radix R turns s interleaved sequences of n numbers into R times as many sequences of m
// = n / R numbers. With w_n = e^(-2 pi i / n),
//   y[q + s (R p + k)] = w_n^(p k) sum_j x[q + s (p + m j)] w_R^(j k).
// Indices: p = 0 ... m - 1, k = 0 ... R - 1, q = 0 ... s - 1; first pass s = 1, last pass m = 1.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "base/aligned_array.h"

namespace rholm {

struct RadixPass {
  std::size_t radix = 1, m = 1, s = 1;
  std::size_t twiddles = 0;  // index of the first factor

  // The factors w_n^(p k), k = 1 ... R - 1. Passes with s = 1 or 4 may have vectors along p: they
  // store, for each k, an array of real and one of imaginary parts, every factor s times. Other
  // passes store both parts of all k for each p.
  bool is_along_p() const { return s == 1 || s == 4; }
  std::size_t copies() const { return is_along_p() ? s : 1; }
  std::size_t twiddle(std::size_t p, std::size_t k) const {
    return is_along_p() ? s * (2 * m * (k - 1) + p) : 2 * (p * (radix - 1) + k - 1);
  }
  std::size_t imaginary() const { return is_along_p() ? s * m : 1; }  // offset from the real part
};

// The passes for one length and their twiddle factors.
template <typename T>
struct RadixPlan {
  std::vector<RadixPass> passes;
  AlignedArray<T> twiddles;
};

// Returns true if n >= 1 has no prime factors other than 2, 3 and 5.
bool is_radix_length(std::size_t n);
template <typename T>
RadixPlan<T> make_radix_plan(std::size_t n);

// Computes X_k = sum_j x_j e^{-2 pi i jk/n}; both arrays hold n numbers, `in` is destroyed.
template <typename T>
void run_radix_plan(const RadixPlan<T>& plan, std::complex<T>* in, std::complex<T>* out);

}  // namespace rholm
