// Edits on one thread: analysis and update of patches of 10 000 movable vertices, as a function of
// the wavelength in edges. Prints CPU time, and the counters `vertices` and `caps`.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include "rholm/primitives.h"
#include "rholm/smooth.h"
#include "rholm/transfer.h"

namespace rholm {
namespace {

const Context kOneThread{.threads = 1, .progress = {}};
constexpr double kEdge = 0.0083;  // mean edge on this sphere
constexpr double kRadius = 0.49;  // radius of a disc with 10 000 vertices
const Vec3 kTop = {0, 0, 1};

const Mesh& sphere() {
  static const Mesh mesh = [] {
    Mesh made = icosphere(7);
    for (Vec3& v : made.vertices) v *= 1 + 0.002 * std::sin(60 * v.x) * std::sin(50 * v.y + v.z);
    return made;
  }();
  return mesh;
}

std::vector<Region> region(double transition) { return {BallRegion{kTop, kRadius - transition}}; }

void analysis(benchmark::State& state, PatchFitting fitting) {
  const double wavelength = kEdge * static_cast<double>(state.range(0));
  Patch patch;
  for (auto _ : state) {
    patch = analyze_patch(sphere(), region(wavelength),
                          {.wavelength = wavelength, .fitting = fitting}, kOneThread);
  }
  state.counters["vertices"] = static_cast<double>(patch.vertices.size());
  state.counters["caps"] = static_cast<double>(patch.caps);
}

void mean_analysis(benchmark::State& state) { analysis(state, PatchFitting::kMean); }
void robust_analysis(benchmark::State& state) { analysis(state, PatchFitting::kRobust); }
BENCHMARK(mean_analysis)->Arg(5)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);
BENCHMARK(robust_analysis)->Arg(5)->Arg(10)->Arg(20)->Unit(benchmark::kMillisecond);

void smooth_update(benchmark::State& state) {
  const double wavelength = 10 * kEdge;
  const Patch patch =
      analyze_patch(sphere(), region(wavelength), {.wavelength = wavelength}, kOneThread);
  double strength = 0;
  for (auto _ : state) {
    strength += 1e-3;
    benchmark::DoNotOptimize(update(patch, {.strength = strength}));
  }
  state.counters["vertices"] = static_cast<double>(patch.vertices.size());
}
BENCHMARK(smooth_update)->Unit(benchmark::kMillisecond);

TransferAnalysis prepared() {
  return analyze_transfer(sphere(), region(0.2), sphere(), region(0.2), {.from_degree = 16},
                          kOneThread);
}

void transfer_analysis(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(prepared());
}
BENCHMARK(transfer_analysis)->Unit(benchmark::kMillisecond);

void transfer_update(benchmark::State& state) {
  const TransferAnalysis analysis = prepared();
  double angle = 0;
  for (auto _ : state) {
    angle += 1e-2;
    benchmark::DoNotOptimize(update(analysis, {.angle = angle, .repeat = state.range(0) != 0}));
  }
  state.counters["vertices"] = static_cast<double>(analysis.patch.vertices.size());
}
BENCHMARK(transfer_update)->ArgName("repeat")->Arg(0)->Arg(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rholm

BENCHMARK_MAIN();
