// Complex transforms of lengths that have prime factors other than 2, 3 and 5, as convolutions with
// a chirp (Bluestein 1970). With w = e^(-2 pi i / n) and jk = (j^2 + k^2 - (k - j)^2) / 2:
//   X_k = w^(k^2/2) sum_j (x_j w^(j^2/2)) w^(-(k-j)^2/2).
// Two transforms of a smooth_length() compute this convolution of at least 2 n - 1 numbers. They
// take five to seven times as long as one such length near n (bench/fft_bench). Layer: harmonic.
#pragma once

#include <complex>
#include <cstddef>

#include "base/aligned_array.h"
#include "harmonic/fft/radix_passes.h"

namespace rholm {

template <typename T>
struct ChirpPlan {
  RadixPlan<T> convolution;                // for spectrum.size() numbers
  AlignedArray<std::complex<T>> chirp;     // w^(j^2/2), j < n
  AlignedArray<std::complex<T>> spectrum;  // transform of w^(-j^2/2), |j| < n, over its length
};

template <typename T>
ChirpPlan<T> make_chirp_plan(std::size_t n);

// Computes X_k = sum_j x_j e^{-2 pi i jk/n}; both arrays hold n numbers.
template <typename T>
void run_chirp_plan(const ChirpPlan<T>& plan, const std::complex<T>* in, std::complex<T>* out);

}  // namespace rholm
