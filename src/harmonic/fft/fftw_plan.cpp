#include <fftw3.h>

#include <map>
#include <mutex>

#include "base/aligned_array.h"
#include "harmonic/fft/complex_plan.h"

namespace rholm {
namespace {

// Plans are estimated, not measured, so that a length gives the same bits in every run.
constexpr unsigned kFlags = FFTW_ESTIMATE | FFTW_DESTROY_INPUT;

fftw_plan make_plan(int n, fftw_complex* in, fftw_complex* out) {
  return fftw_plan_dft_1d(n, in, out, FFTW_FORWARD, kFlags);
}
fftwf_plan make_plan(int n, fftwf_complex* in, fftwf_complex* out) {
  return fftwf_plan_dft_1d(n, in, out, FFTW_FORWARD, kFlags);
}

template <typename T>
struct Fftw;
template <>
struct Fftw<double> {
  using Complex = fftw_complex;
  using Plan = fftw_plan;
  static void guard_planner() { fftw_make_planner_thread_safe(); }
};
template <>
struct Fftw<float> {
  using Complex = fftwf_complex;
  using Plan = fftwf_plan;
  static void guard_planner() { fftwf_make_planner_thread_safe(); }
};

}  // namespace

template <typename T>
const void* complex_plan(std::size_t n) {
  using Complex = typename Fftw<T>::Complex;
  static std::mutex mutex;
  static auto& plans = *new std::map<std::size_t, typename Fftw<T>::Plan>;
  const std::lock_guard lock(mutex);
  // The process has one planner, which the program itself may also call: guard it with a lock.
  if (plans.empty()) Fftw<T>::guard_planner();
  auto& plan = plans[n];
  if (plan == nullptr) {
    AlignedArray<T> in(2 * n), out(2 * n);
    plan = make_plan(static_cast<int>(n), reinterpret_cast<Complex*>(in.data()),
                     reinterpret_cast<Complex*>(out.data()));
  }
  return plan;
}

void execute_plan(const void* plan, std::complex<double>* in, std::complex<double>* out) {
  fftw_execute_dft(static_cast<fftw_plan>(const_cast<void*>(plan)),
                   reinterpret_cast<fftw_complex*>(in), reinterpret_cast<fftw_complex*>(out));
}
void execute_plan(const void* plan, std::complex<float>* in, std::complex<float>* out) {
  fftwf_execute_dft(static_cast<fftwf_plan>(const_cast<void*>(plan)),
                    reinterpret_cast<fftwf_complex*>(in), reinterpret_cast<fftwf_complex*>(out));
}

template const void* complex_plan<float>(std::size_t);
template const void* complex_plan<double>(std::size_t);

}  // namespace rholm
