// Fourier transforms of rows. The one user of FFTW.
//
// Plans are estimated, not measured, so that a size gives the same bits in every run; made under
// FFTW's own lock and kept for the life of the process. Executing them needs no lock. Only complex
// transforms out of place are planned: planning real ones takes FFTW ten times as long (5 to 15
// ms) as small problems take in all.
#pragma once

#include <complex>
#include <cstddef>

#include "base/aligned_array.h"

namespace rholm {

// The smallest n' >= n that is fast to transform and a multiple of `multiple` (a power of two):
// 1, 5 or 25 times a power of two, at least 16 from 128 on. (A factor 3 costs up to twice the time
// and 0.3 ms of planning, measured.)
std::size_t smooth_length(std::size_t n, std::size_t multiple = 1);

// X_k = sum_j x_j e^{-2 pi i jk/n}, n complex numbers, T float or double. `in` is destroyed.
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
