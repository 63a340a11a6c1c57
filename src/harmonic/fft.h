// Fourier transforms of rows, in place. The one user of FFTW.
//
// Plans are estimated, not measured, so that a size gives the same bits in every run. They are made
// under FFTW's own lock and kept for the life of the process; executing them needs no lock. Rows
// must be aligned to 16 bytes.
#pragma once

#include <complex>
#include <cstddef>

namespace rholm {

// The smallest n' >= n that is a multiple of `multiple` and has no prime factors but 2, 3 and 5
// (as `multiple` must): lengths that are fast.
std::size_t smooth_length(std::size_t n, std::size_t multiple = 1);

// Of n real numbers x_j, T float or double.
template <typename T>
class RealFft {
 public:
  explicit RealFft(std::size_t n);
  // Reals in a row at least: the n / 2 + 1 complex numbers take the place of the n reals.
  static std::size_t row_size(std::size_t n) { return 2 * (n / 2 + 1); }
  // X_k = sum_j x_j e^{-2 pi i jk/n}, k = 0 ... n/2.
  void forward(T* row) const;
  // x_j = sum over k = -n/2 ... n/2 of X_k e^{+2 pi i jk/n}, X_-k = conj(X_k): not divided by n.
  void backward(T* row) const;

 private:
  const void* forward_;
  const void* backward_;
};

// Of n complex numbers, neither way divided by n.
class ComplexFft {
 public:
  explicit ComplexFft(std::size_t n);
  void forward(std::complex<double>* row) const;   // e^{-2 pi i jk/n}
  void backward(std::complex<double>* row) const;  // e^{+2 pi i jk/n}

 private:
  const void* forward_;
  const void* backward_;
};

}  // namespace rholm
