// Complex transforms by our own passes and by FFTW, and the time of planning them. Plans use some
// of these lengths; others have a factor 3, which plans do not use, or are prime.
//   fft_bench --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
#include <benchmark/benchmark.h>
#include <fftw3.h>

#include <algorithm>
#include <complex>
#include <cstddef>

#include "base/aligned_array.h"
#include "harmonic/fft/chirp_plan.h"
#include "harmonic/fft/radix_passes.h"

namespace rholm {
namespace {

struct Single {
  using Real = float;
  using Plan = fftwf_plan;
  static Plan plan(int n, std::complex<float>* in, std::complex<float>* out) {
    return fftwf_plan_dft_1d(n, reinterpret_cast<fftwf_complex*>(in),
                             reinterpret_cast<fftwf_complex*>(out), FFTW_FORWARD,
                             FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  }
  static void execute(Plan plan) { fftwf_execute(plan); }
  static void destroy(Plan plan) { fftwf_destroy_plan(plan); }
};
struct Double {
  using Real = double;
  using Plan = fftw_plan;
  static Plan plan(int n, std::complex<double>* in, std::complex<double>* out) {
    return fftw_plan_dft_1d(n, reinterpret_cast<fftw_complex*>(in),
                            reinterpret_cast<fftw_complex*>(out), FFTW_FORWARD,
                            FFTW_ESTIMATE | FFTW_DESTROY_INPUT);
  }
  static void execute(Plan plan) { fftw_execute(plan); }
  static void destroy(Plan plan) { fftw_destroy_plan(plan); }
};

template <typename T>
struct Rows {
  explicit Rows(std::size_t n) : source(n), in(n), out(n) {
    for (std::size_t j = 0; j < n; ++j) {
      source[j] = {static_cast<T>(j % 7) - T(3), static_cast<T>(j % 11) - T(5)};
    }
  }
  void load() { std::copy(source.begin(), source.end(), in.begin()); }
  AlignedArray<std::complex<T>> source, in, out;
};

template <typename Kind>
void ours(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  Rows<typename Kind::Real> rows(n);
  if (is_radix_length(n)) {
    const auto plan = make_radix_plan<typename Kind::Real>(n);
    for (auto _ : state) {
      rows.load();
      run_radix_plan(plan, rows.in.data(), rows.out.data());
    }
  } else {
    const auto plan = make_chirp_plan<typename Kind::Real>(n);
    for (auto _ : state) {
      rows.load();
      run_chirp_plan(plan, rows.in.data(), rows.out.data());
    }
  }
}

template <typename Kind>
void fftw(benchmark::State& state) {
  Rows<typename Kind::Real> rows(static_cast<std::size_t>(state.range(0)));
  const typename Kind::Plan plan =
      Kind::plan(static_cast<int>(state.range(0)), rows.in.data(), rows.out.data());
  for (auto _ : state) {
    rows.load();
    Kind::execute(plan);
  }
  Kind::destroy(plan);
}

template <typename Kind>
void our_plan(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  for (auto _ : state) {
    if (is_radix_length(n)) {
      benchmark::DoNotOptimize(make_radix_plan<typename Kind::Real>(n));
    } else {
      benchmark::DoNotOptimize(make_chirp_plan<typename Kind::Real>(n));
    }
  }
}

void lengths(benchmark::internal::Benchmark* bench) {
  for (const int n : {64,   80,   128,  160,  200, 256, 320, 400, 512,  640, 800, 1024,
                      1280, 2048, 2560, 4096, 96,  192, 384, 768, 1536, 181, 361, 961}) {
    bench->Arg(n);
  }
}

BENCHMARK(ours<Single>)->Apply(lengths);
BENCHMARK(fftw<Single>)->Apply(lengths);
BENCHMARK(ours<Double>)->Apply(lengths);
BENCHMARK(fftw<Double>)->Apply(lengths);
BENCHMARK(our_plan<Double>)->Apply(lengths);

}  // namespace
}  // namespace rholm

BENCHMARK_MAIN();
