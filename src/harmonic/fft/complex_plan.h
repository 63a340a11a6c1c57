// Plans of complex transforms of one length: our own passes (radix_plan.cpp), or FFTW where the
// library is configured with RHOLM_FFTW (fftw_plan.cpp). Layer: harmonic.
#pragma once

#include <complex>
#include <cstddef>

namespace rholm {

// Returns the plan for n numbers of type T, float or double. Plans are made at first use and then
// kept for the life of the process, which needs few lengths. Thread-safe.
template <typename T>
const void* complex_plan(std::size_t n);

// Computes X_k = sum_j x_j e^{-2 pi i jk/n} and destroys `in`. Several threads may call it at once.
void execute_plan(const void* plan, std::complex<float>* in, std::complex<float>* out);
void execute_plan(const void* plan, std::complex<double>* in, std::complex<double>* out);

}  // namespace rholm
