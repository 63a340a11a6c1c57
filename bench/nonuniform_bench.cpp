// The nonuniform transforms, stage by stage, on one thread. Counters are seconds per source, per
// source and coefficient ("term"), and per cell of the grid.
//
// Lower bounds for comparison: `rows` updates the same cells with constant windows, `copy` moves
// memory. Sources are in the order of a mesh: rows of points on the faces of a cube, each moved
// slightly.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "harmonic/nonuniform/nonuniform.h"
#include "mesh_sources.h"

namespace rholm {
namespace {

const Context kOneThread = {.threads = 1, .progress = {}};

void count(benchmark::State& state, const char* name, double per_iteration) {
  state.counters[name] =
      benchmark::Counter(static_cast<double>(state.iterations()) * per_iteration,
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// Arguments: width, derivatives.
template <typename T, bool kSpread>
void sources(benchmark::State& state) {
  const SphereFourier fourier = fourier_of<T>(static_cast<int>(state.range(0)), kDegree, 1.5);
  const int derivatives = static_cast<int>(state.range(1));
  const GridKernel<T> kernel = grid_kernel<T>(fourier);
  using Cell = std::conditional_t<kSpread, double, T>;
  AlignedArray<Cell> grid(fourier.layout.cells());
  std::fill(grid.begin(), grid.end(), Cell{0});
  auto batches = some_batches<T>();
  PolarSources polar;
  for (auto _ : state) {
    for (SourceBatch<T>& batch : batches) {
      if constexpr (kSpread) {
        spread(kernel, batch, batch.kSize, derivatives, 0.0, grid.data(), polar);
      } else {
        interpolate(kernel, grid.data(), batch.kSize, derivatives, 0.0, batch, polar);
      }
    }
    benchmark::ClobberMemory();
  }
  count(state, "s/source", static_cast<double>(batches.size() * SourceBatch<T>::kSize));
}
void widths_and_derivatives(benchmark::internal::Benchmark* benchmark) {
  for (const int width : {4, 6, 8, 12, 16}) {
    for (const int derivatives : {0, 1, 2}) benchmark->Args({width, derivatives});
  }
}
void widths_and_gradients(benchmark::internal::Benchmark* benchmark) {
  for (const int width : {4, 6, 8, 12, 16}) {
    for (const int derivatives : {0, 1}) benchmark->Args({width, derivatives});
  }
}
BENCHMARK(sources<float, true>)->Name("spread/single")->Apply(widths_and_derivatives);
BENCHMARK(sources<double, true>)->Name("spread/double")->Apply(widths_and_derivatives);
BENCHMARK(sources<float, false>)->Name("interpolate/single")->Apply(widths_and_gradients);
BENCHMARK(sources<double, false>)->Name("interpolate/double")->Apply(widths_and_gradients);

// Spreading without windows: row updates of sources whose cells are known.
struct Placement {
  std::vector<std::size_t> cell;
  std::size_t stride = 0;
};
template <typename T>
Placement placement_of(const GridLayout& layout) {
  Placement placement{.cell = {}, .stride = layout.stride};
  constexpr double kPi = 3.14159265358979324;
  for (const SourceBatch<T>& batch : some_batches<T>()) {
    for (std::size_t j = 0; j < batch.kSize; ++j) {
      const double x = batch.x[0][j], y = batch.x[1][j], z = batch.x[2][j];
      const double phi = std::atan2(y, x) + kPi, theta = std::atan2(std::hypot(x, y), z);
      const auto row = static_cast<std::size_t>(theta / (2 * kPi) * double(layout.n_theta));
      const auto column = static_cast<std::size_t>(phi / (2 * kPi) * double(layout.n_phi));
      placement.cell.push_back(row * layout.stride + column);
    }
  }
  return placement;
}

#if defined(__x86_64__) && defined(__linux__)
#define RHOLM_CLONES __attribute__((target_clones("avx512f", "arch=haswell", "default")))
#else
#define RHOLM_CLONES
#endif
RHOLM_CLONES void update_rows(const Placement& placement, int width, int taps,
                              const double* __restrict window, double* __restrict grid) {
  for (const std::size_t cell : placement.cell) {
    double* row = grid + cell;
    for (int i = 0; i < width; ++i, row += placement.stride) {
      for (int k = 0; k < taps; k += 8) {
        for (int lane = k; lane < k + 8; ++lane) row[lane] += window[16 + i] * window[lane];
      }
    }
  }
}

// Argument: width. A row has eight taps up to width 8, and sixteen beyond.
void rows(benchmark::State& state) {
  const int width = static_cast<int>(state.range(0));
  const GridLayout layout = fourier_of<double>(width, kDegree, 1.5).layout;
  const Placement placement = placement_of<double>(layout);
  AlignedArray<double> grid(layout.cells()), window(32);
  std::fill(grid.begin(), grid.end(), 0.0);
  std::fill(window.begin(), window.end(), 0.001);
  for (auto _ : state) {
    update_rows(placement, width, width <= 8 ? 8 : 16, window.data(), grid.data());
    benchmark::ClobberMemory();
  }
  count(state, "s/source", static_cast<double>(placement.cell.size()));
}
BENCHMARK(rows)->Arg(6)->Arg(8)->Arg(12)->Arg(16);

void copy(benchmark::State& state) {
  const std::size_t bytes = std::size_t{1} << 26;
  AlignedArray<char> from(bytes), to(bytes);
  std::memset(from.data(), 1, bytes);
  for (auto _ : state) {
    std::memcpy(to.data(), from.data(), bytes);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * bytes));
}
BENCHMARK(copy)->Unit(benchmark::kMillisecond);

Coefficients some_coefficients(int degree) {
  Coefficients f(degree);
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) f.c(l, m) = 1.0 / (1 + l + m);
  }
  return f;
}

// Measures the stage between grid and coefficients. Argument: degree.
void fourier_adjoint(benchmark::State& state) {
  const int degree = static_cast<int>(state.range(0));
  const SphereFourier stage = fourier_of<double>(6, degree, 1.4);
  AlignedArray<double> grid(stage.layout.cells());
  std::fill(grid.begin(), grid.end(), 0.5);
  Coefficients sum = some_coefficients(degree);
  double* const grids[] = {grid.data()};
  for (auto _ : state) {
    grid_to_coefficients(stage, grids, sum, kOneThread, {});
    state.PauseTiming();
    std::fill(grid.begin(), grid.end(), 0.5);
    state.ResumeTiming();
  }
  count(state, "s/cell", static_cast<double>(stage.layout.cells()));
  state.counters["points"] = static_cast<double>(stage.layout.n_phi);
}
template <typename T>
void fourier_forward(benchmark::State& state) {
  const int degree = static_cast<int>(state.range(0));
  const SphereFourier stage = fourier_of<T>(6, degree, 1.4);
  AlignedArray<T> grid(stage.layout.cells());
  const Coefficients sum = some_coefficients(degree);
  for (auto _ : state) coefficients_to_grid(stage, sum, grid.data(), kOneThread, {});
  count(state, "s/cell", static_cast<double>(stage.layout.cells()));
  state.counters["points"] = static_cast<double>(stage.layout.n_phi);
}
void degrees(benchmark::internal::Benchmark* benchmark) {
  for (const int degree : {64, 180, 256, 480, 1000}) benchmark->Arg(degree);
  benchmark->Unit(benchmark::kMillisecond);
}
BENCHMARK(fourier_adjoint)->Apply(degrees);
BENCHMARK(fourier_forward<float>)->Name("fourier_forward/single")->Apply(degrees);
BENCHMARK(fourier_forward<double>)->Name("fourier_forward/double")->Apply(degrees);

// Measures whole transforms with the library's own plan. Arguments: points along a cube's edge,
// degree, number of decimal digits, derivatives.
void adjoint(benchmark::State& state, Engine engine) {
  const std::vector<Vec3>& directions = directions_of(state.range(0));
  const int degree = static_cast<int>(state.range(1));
  const SumOptions options{.engine = engine, .precision = std::pow(10.0, -double(state.range(2)))};
  const std::vector<double> weights(directions.size(), 1.0);
  std::vector<Vec3> gradients;
  if (state.range(3) > 0) gradients.assign(directions.size(), {0.01, 0.02, 0.03});
  for (auto _ : state) {
    Coefficients sum(degree);
    add_adjoint({directions, weights, gradients, {}}, sum, options, kOneThread);
    benchmark::DoNotOptimize(sum.values().data());
  }
  count(state, "s/source", static_cast<double>(directions.size()));
}
void forward(benchmark::State& state, Engine engine) {
  const std::vector<Vec3>& directions = directions_of(state.range(0));
  const Coefficients f = some_coefficients(static_cast<int>(state.range(1)));
  const SumOptions options{.engine = engine, .precision = std::pow(10.0, -double(state.range(2)))};
  for (auto _ : state) {
    if (state.range(3) > 0) {
      benchmark::DoNotOptimize(evaluate_with_gradient(f, directions, options, kOneThread));
    } else {
      benchmark::DoNotOptimize(evaluate(f, directions, options, kOneThread));
    }
  }
  count(state, "s/source", static_cast<double>(directions.size()));
}
void problems(benchmark::internal::Benchmark* benchmark) {
  for (const int digits : {6, 12}) {
    for (const int derivatives : {0, 1}) {
      benchmark->Args({kMedium, 256, digits, derivatives});
      benchmark->Args({kLarge, 480, digits, derivatives});
    }
  }
  benchmark->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(adjoint, fast, Engine::kFast)->Apply(problems);
BENCHMARK_CAPTURE(forward, fast, Engine::kFast)->Apply(problems);
BENCHMARK_CAPTURE(adjoint, direct, Engine::kDirect)
    ->Args({kMedium, 256, 6, 0})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(forward, direct, Engine::kDirect)
    ->Args({kMedium, 256, 6, 0})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rholm

BENCHMARK_MAIN();
