#include "harmonic/fft/chirp_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/poison.h"
#include "harmonic/fft/fft.h"

namespace rholm {
namespace {

// Multiplies without the checks for infinite factors of the operator of the standard library.
template <typename T>
std::complex<T> times(const std::complex<T>& a, const std::complex<T>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

template <typename T>
struct Scratch {
  AlignedArray<std::complex<T>> first, second;
};

template <typename T>
Scratch<T>& scratch_of(std::size_t n) {
  thread_local Scratch<T> scratch;
  if (scratch.first.size() < n) {
    scratch.first = AlignedArray<std::complex<T>>(n);
    scratch.second = AlignedArray<std::complex<T>>(n);
  }
  poison_scratch(scratch.first.data(), n * sizeof(std::complex<T>));
  poison_scratch(scratch.second.data(), n * sizeof(std::complex<T>));
  return scratch;
}

}  // namespace

template <typename T>
ChirpPlan<T> make_chirp_plan(std::size_t n) {
  const std::size_t length = smooth_length(2 * n - 1);
  ChirpPlan<T> plan{.convolution = make_radix_plan<T>(length),
                    .chirp = AlignedArray<std::complex<T>>(n),
                    .spectrum = AlignedArray<std::complex<T>>(length)};
  AlignedArray<std::complex<T>> filter(length);
  std::fill(filter.begin(), filter.end(), std::complex<T>{});
  const double share = 1 / static_cast<double>(length);
  for (std::size_t j = 0; j < n; ++j) {
    const double angle =
        std::numbers::pi * static_cast<double>(j * j % (2 * n)) / static_cast<double>(n);
    const double c = std::cos(angle), s = std::sin(angle);
    plan.chirp[j] = {static_cast<T>(c), static_cast<T>(-s)};
    filter[j] = {static_cast<T>(share * c), static_cast<T>(share * s)};
    if (j > 0) filter[length - j] = filter[j];
  }
  run_radix_plan(plan.convolution, filter.data(), plan.spectrum.data());
  return plan;
}

// The second, inverse transform is computed as the conjugate of a forward transform of conjugates.
template <typename T>
void run_chirp_plan(const ChirpPlan<T>& plan, const std::complex<T>* in, std::complex<T>* out) {
  const std::size_t n = plan.chirp.size(), length = plan.spectrum.size();
  Scratch<T>& scratch = scratch_of<T>(length);
  std::complex<T>*const a = scratch.first.data(), *const b = scratch.second.data();
  for (std::size_t j = 0; j < n; ++j) a[j] = times(in[j], plan.chirp[j]);
  std::fill(a + n, a + length, std::complex<T>{});
  run_radix_plan(plan.convolution, a, b);
  for (std::size_t k = 0; k < length; ++k) b[k] = std::conj(times(b[k], plan.spectrum[k]));
  run_radix_plan(plan.convolution, b, a);
  for (std::size_t k = 0; k < n; ++k) out[k] = times(std::conj(a[k]), plan.chirp[k]);
}

template ChirpPlan<float> make_chirp_plan(std::size_t);
template ChirpPlan<double> make_chirp_plan(std::size_t);
template void run_chirp_plan(const ChirpPlan<float>&, const std::complex<float>*,
                             std::complex<float>*);
template void run_chirp_plan(const ChirpPlan<double>&, const std::complex<double>*,
                             std::complex<double>*);

}  // namespace rholm
