// Fourier transforms of rows.
//
// A plan is made when a length is first asked for and kept for the life of the process; it depends
// on the length alone, so that the same rows give the same bits in every run. Real transforms of n
// are complex ones of n / 2.
#pragma once

#include <complex>
#include <cstddef>

#include "base/aligned_array.h"

namespace rholm {

// The smallest n' >= n that is fast to transform and a multiple of `multiple` (a power of two):
// 1, 5 or 25 times a power of two, at least 16 from 128 on.
std::size_t smooth_length(std::size_t n, std::size_t multiple = 1);

// X_k = sum_j x_j e^{-2 pi i jk/n}, n >= 1 complex numbers, T float or double. `in` is destroyed.
// Lengths with other prime factors than 2, 3 and 5 take five to seven times as long
// (bench/fft_bench).
template <typename T>
class ComplexFft {
 public:
  explicit ComplexFft(std::size_t n);
  void forward(std::complex<T>* in, std::complex<T>* out) const;

 private:
  const void* plan_;
};

// Of n real numbers, n even.
template <typename T>
class RealFft {
 public:
  explicit RealFft(std::size_t n);
  // X_k = sum_j x_j e^{-2 pi i jk/n}, k = 0 ... used - 1 <= n/2, in the place of the n reals: a row
  // has room for n + 2. `work`: n + 2 numbers more. May write, in the row, numbers up to k = n/2.
  void forward(T* row, std::size_t used, T* work) const;
  // x_j = sum over |k| < used of X_k e^{+2 pi i jk/n}, X_-k = conj(X_k), used <= n/2.
  void backward(T* row, std::size_t used, T* work) const;

 private:
  std::size_t half_;
  ComplexFft<T> fft_;
  AlignedArray<T> cosine_, sine_;  // of e^{-2 pi i k/n}, k = 0 ... n/2
};

}  // namespace rholm
