// Fourier transforms of rows.
//
// A plan is made when a length is first used and is kept for the life of the process. It depends on
// the length alone, so that the same rows give the same bits in every run. A real transform of n
// numbers uses a complex transform of n / 2.
#pragma once

#include <complex>
#include <cstddef>

#include "base/aligned_array.h"

namespace rholm {

// Returns the smallest length >= n that is fast to transform and a multiple of `multiple`, a power
// of two. It is 1, 5 or 25 times a power of two; this power is at least 16 from n = 128 on.
std::size_t smooth_length(std::size_t n, std::size_t multiple = 1);

// Computes X_k = sum_j x_j e^{-2 pi i jk/n} of n >= 1 complex numbers; T is float or double.
// Destroys `in`. Lengths that have prime factors other than 2, 3 and 5 take five to seven times as
// long (bench/fft_bench).
template <typename T>
class ComplexFft {
 public:
  explicit ComplexFft(std::size_t n);
  void forward(std::complex<T>* in, std::complex<T>* out) const;

 private:
  const void* plan_;
};

// Transforms n real numbers, n even.
template <typename T>
class RealFft {
 public:
  explicit RealFft(std::size_t n);
  // Replaces the n reals of `row` by X_k = sum_j x_j e^{-2 pi i jk/n}, k = 0 ... used - 1 <= n/2.
  // `row` and `work` each hold n + 2 numbers. May also write X_k up to k = n/2.
  void forward(T* row, std::size_t used, T* work) const;
  // Inverts: x_j = sum over |k| < used of X_k e^{+2 pi i jk/n}, X_-k = conj(X_k), used <= n/2.
  void backward(T* row, std::size_t used, T* work) const;

 private:
  std::size_t half_;
  ComplexFft<T> fft_;
  AlignedArray<T> cosine_, sine_;  // parts of e^{-2 pi i k/n}, k = 0 ... n/2
};

}  // namespace rholm
