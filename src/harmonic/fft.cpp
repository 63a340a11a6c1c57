#include "harmonic/fft.h"

#include <fftw3.h>

#include <array>
#include <map>
#include <mutex>

#include "base/aligned_array.h"

namespace rholm {
namespace {

constexpr unsigned kFlags = FFTW_ESTIMATE | FFTW_DESTROY_INPUT;

// FFTW's planner is one per process: besides ours, the program's own calls must not meet in it.
void guard_planner() {
  static const bool done = [] {
    fftw_make_planner_thread_safe();
    fftwf_make_planner_thread_safe();
    return true;
  }();
  static_cast<void>(done);
}

// Plans by length, made by make(n) when first asked for. They are never freed: a program uses a
// handful of lengths.
template <typename Make>
const void* cached(std::map<std::size_t, const void*>& plans, std::size_t n, const Make& make) {
  static std::mutex mutex;
  guard_planner();
  const std::lock_guard lock(mutex);
  const void*& plan = plans[n];
  if (plan == nullptr) plan = make(static_cast<int>(n));
  return plan;
}

const void* real_plan(double, bool forward, std::size_t n) {
  static std::array<std::map<std::size_t, const void*>, 2> plans;
  return cached(plans[forward], n, [&](int length) -> const void* {
    AlignedArray<double> row(RealFft<double>::row_size(n));
    auto* out = reinterpret_cast<fftw_complex*>(row.data());
    return forward ? fftw_plan_dft_r2c_1d(length, row.data(), out, kFlags)
                   : fftw_plan_dft_c2r_1d(length, out, row.data(), kFlags);
  });
}

const void* real_plan(float, bool forward, std::size_t n) {
  static std::array<std::map<std::size_t, const void*>, 2> plans;
  return cached(plans[forward], n, [&](int length) -> const void* {
    AlignedArray<float> row(RealFft<float>::row_size(n));
    auto* out = reinterpret_cast<fftwf_complex*>(row.data());
    return forward ? fftwf_plan_dft_r2c_1d(length, row.data(), out, kFlags)
                   : fftwf_plan_dft_c2r_1d(length, out, row.data(), kFlags);
  });
}

const void* complex_plan(bool forward, std::size_t n) {
  static std::array<std::map<std::size_t, const void*>, 2> plans;
  return cached(plans[forward], n, [&](int length) -> const void* {
    AlignedArray<double> row(2 * n);
    auto* data = reinterpret_cast<fftw_complex*>(row.data());
    return fftw_plan_dft_1d(length, data, data, forward ? FFTW_FORWARD : FFTW_BACKWARD, kFlags);
  });
}

fftw_plan plan_of(double, const void* plan) {
  return static_cast<fftw_plan>(const_cast<void*>(plan));
}
fftwf_plan plan_of(float, const void* plan) {
  return static_cast<fftwf_plan>(const_cast<void*>(plan));
}

void execute(const void* plan, bool forward, double* row) {
  auto* complex = reinterpret_cast<fftw_complex*>(row);
  if (forward) {
    fftw_execute_dft_r2c(plan_of(0.0, plan), row, complex);
  } else {
    fftw_execute_dft_c2r(plan_of(0.0, plan), complex, row);
  }
}

void execute(const void* plan, bool forward, float* row) {
  auto* complex = reinterpret_cast<fftwf_complex*>(row);
  if (forward) {
    fftwf_execute_dft_r2c(plan_of(0.0F, plan), row, complex);
  } else {
    fftwf_execute_dft_c2r(plan_of(0.0F, plan), complex, row);
  }
}

void execute(const void* plan, std::complex<double>* row) {
  auto* complex = reinterpret_cast<fftw_complex*>(row);
  fftw_execute_dft(plan_of(0.0, plan), complex, complex);
}

bool is_smooth(std::size_t n) {
  for (const std::size_t p : {2, 3, 5}) {
    while (n % p == 0) n /= p;
  }
  return n == 1;
}

}  // namespace

std::size_t smooth_length(std::size_t n, std::size_t multiple) {
  std::size_t factor = n <= multiple ? 1 : (n + multiple - 1) / multiple;
  while (!is_smooth(factor)) ++factor;
  return factor * multiple;
}

template <typename T>
RealFft<T>::RealFft(std::size_t n)
    : forward_(real_plan(T{}, true, n)), backward_(real_plan(T{}, false, n)) {}

template <typename T>
void RealFft<T>::forward(T* row) const {
  execute(forward_, true, row);
}

template <typename T>
void RealFft<T>::backward(T* row) const {
  execute(backward_, false, row);
}

template class RealFft<float>;
template class RealFft<double>;

ComplexFft::ComplexFft(std::size_t n)
    : forward_(complex_plan(true, n)), backward_(complex_plan(false, n)) {}

void ComplexFft::forward(std::complex<double>* row) const { execute(forward_, row); }
void ComplexFft::backward(std::complex<double>* row) const { execute(backward_, row); }

}  // namespace rholm
