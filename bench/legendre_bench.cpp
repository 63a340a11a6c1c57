// The Legendre stage on L + 1 Gauss rings, and whole transforms of the smallest grids of degree L.
// If the build has found libsharp, it is compared. One of its transforms is whole, and one has a
// single longitude, which amounts to its Legendre stage and a pass over its phases.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#ifdef RHOLM_HAS_LIBSHARP
#include <libsharp/sharp.h>
#include <libsharp/sharp_almhelpers.h>
#include <libsharp/sharp_geomhelpers.h>
#endif

#include "base/aligned_array.h"
#include "base/parallel.h"
#include "harmonic/rings/ring_sums.h"
#include "rholm/grid.h"
#include "rholm/harmonic.h"

namespace rholm {
namespace {

HalfRings gauss_rings(int degree) {
  const GaussRule rule = gauss_legendre(degree + 1);
  std::vector<double> colatitudes;
  for (int i = 0; 2 * i <= degree; ++i) colatitudes.push_back(std::acos(rule.nodes[i]));
  return HalfRings(colatitudes);
}

// The rows are indexed [order][even_re, even_im, odd_re, odd_im][ring].
AlignedArray<double> some_rows(int degree, const HalfRings& rings) {
  AlignedArray<double> rows((degree + std::size_t{1}) * 4 * rings.padded);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] = i % rings.padded < rings.size ? 1 / (1.0 + static_cast<double>(i % 97)) : 0;
  }
  return rows;
}

enum class Way { kAdjoint, kForward };

void rings(benchmark::State& state, Way way) {
  const int degree = static_cast<int>(state.range(0));
  const Context context = {.threads = static_cast<int>(state.range(1)), .progress = {}};
  const HalfRings half = gauss_rings(degree);
  AlignedArray<double> rows = some_rows(degree, half);
  const RingTables tables(degree);
  const std::size_t orders = degree + std::size_t{1};
  std::vector<double> coefficients(orders * 2 * orders, 0.5);
  for (auto _ : state) {
    parallel_for(orders, 4, context, {}, [&](std::size_t begin, std::size_t end) {
      RingOrder order;
      for (std::size_t m = begin; m < end; ++m) {
        set_ring_order(tables, static_cast<int>(m), order);
        double* row = rows.data() + m * 4 * half.padded;
        double* c = coefficients.data() + m * 2 * orders;
        double* part[4] = {row, row + half.padded, row + 2 * half.padded, row + 3 * half.padded};
        if (way == Way::kAdjoint) {
          ring_adjoint(order, half, part[0], part[1], part[2], part[3], c, c + orders);
        } else {
          ring_forward(order, half, c, c + orders, part[0], part[1], part[2], part[3]);
        }
      }
    });
    benchmark::ClobberMemory();
  }
}

void degrees(benchmark::internal::Benchmark* benchmark) {
  for (const int threads : {1, 2}) {
    for (const int degree : {256, 480, 1000, 2000}) benchmark->Args({degree, threads});
  }
  benchmark->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}
BENCHMARK_CAPTURE(rings, adjoint, Way::kAdjoint)->Apply(degrees);
BENCHMARK_CAPTURE(rings, forward, Way::kForward)->Apply(degrees);

void grids(benchmark::State& state, GridKind kind, Way way) {
  const int degree = static_cast<int>(state.range(0));
  const Context context = {.threads = static_cast<int>(state.range(1)), .progress = {}};
  const Grid grid = smallest_grid(kind, degree);
  const std::vector<double> values(
      static_cast<std::size_t>(grid.n_theta) * static_cast<std::size_t>(grid.n_phi), 0.5);
  const Coefficients coefficients(degree);
  for (auto _ : state) {
    if (way == Way::kAdjoint) {
      benchmark::DoNotOptimize(analyze_grid(values, grid, degree, context));
    } else {
      benchmark::DoNotOptimize(synthesize_grid(coefficients, grid, context));
    }
  }
}
BENCHMARK_CAPTURE(grids, gauss_analysis, GridKind::kGaussLegendre, Way::kAdjoint)->Apply(degrees);
BENCHMARK_CAPTURE(grids, gauss_synthesis, GridKind::kGaussLegendre, Way::kForward)->Apply(degrees);
BENCHMARK_CAPTURE(grids, equiangular_analysis, GridKind::kEquiangular, Way::kAdjoint)
    ->Apply(degrees);

#ifdef RHOLM_HAS_LIBSHARP
// Runs on the number of threads that OMP_NUM_THREADS has when the program starts.
void libsharp(benchmark::State& state, Way way, bool whole) {
  const int degree = static_cast<int>(state.range(0));
  const int n_phi = whole ? smallest_grid(GridKind::kGaussLegendre, degree).n_phi : 1;
  sharp_geom_info* grid = nullptr;
  sharp_make_gauss_geom_info(degree + 1, n_phi, 0, 1, n_phi, &grid);
  sharp_alm_info* layout = nullptr;
  sharp_make_triangular_alm_info(degree, degree, 1, &layout);
  std::vector<double> map((degree + std::size_t{1}) * n_phi, 0.5);
  std::vector<double> alm((degree + std::size_t{1}) * (degree + 2), 0.5);
  void* maps[] = {map.data()};
  void* alms[] = {alm.data()};
  for (auto _ : state) {
    sharp_execute(way == Way::kAdjoint ? SHARP_MAP2ALM : SHARP_ALM2MAP, 0, alms, maps, grid, layout,
                  SHARP_DP, nullptr, nullptr);
    benchmark::ClobberMemory();
  }
  sharp_destroy_alm_info(layout);
  sharp_destroy_geom_info(grid);
}
void sharp_degrees(benchmark::internal::Benchmark* benchmark) {
  for (const int degree : {256, 480, 1000, 2000}) benchmark->Arg(degree);
  benchmark->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}
BENCHMARK_CAPTURE(libsharp, adjoint, Way::kAdjoint, false)->Apply(sharp_degrees);
BENCHMARK_CAPTURE(libsharp, forward, Way::kForward, false)->Apply(sharp_degrees);
BENCHMARK_CAPTURE(libsharp, whole_adjoint, Way::kAdjoint, true)->Apply(sharp_degrees);
BENCHMARK_CAPTURE(libsharp, whole_forward, Way::kForward, true)->Apply(sharp_degrees);
#endif

}  // namespace
}  // namespace rholm

BENCHMARK_MAIN();
