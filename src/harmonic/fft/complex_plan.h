// What executes a complex transform of one length: our own passes (radix_plan.cpp), or FFTW where
// the library is configured with RHOLM_FFTW (fftw_plan.cpp). Layer: harmonic.
#pragma once

#include <complex>
#include <cstddef>

namespace rholm {

// Of T float or double, made when a length is first asked for and kept for the life of the process:
// a program uses a handful of lengths. May be called by several threads at once.
template <typename T>
const void* complex_plan(std::size_t n);

// X_k = sum_j x_j e^{-2 pi i jk/n}. `in` is destroyed. May be called by several threads at once.
void execute_plan(const void* plan, std::complex<float>* in, std::complex<float>* out);
void execute_plan(const void* plan, std::complex<double>* in, std::complex<double>* out);

}  // namespace rholm
