// Direct sums: nanoseconds per source and coefficient; and whole transforms of a bumpy sphere, on
// one thread.
#include <benchmark/benchmark.h>

#include <vector>

#include "rholm/harmonic.h"
#include "rholm/primitives.h"
#include "rholm/transform.h"

namespace rholm {
namespace {

const Context kOneThread = {.threads = 1, .progress = {}};

Coefficients some_coefficients(int degree) {
  Coefficients f(degree);
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) f.c(l, m) = 1.0 / (1 + l + m);
  }
  return f;
}

// Returns 40 962 directions in the order of a mesh, as for sources of edges and faces.
const std::vector<Vec3>& directions() {
  static const std::vector<Vec3> vertices = icosphere(6).vertices;
  return vertices;
}

void count_sources(benchmark::State& state, int degree) {
  const double sources =
      static_cast<double>(state.iterations()) * static_cast<double>(directions().size());
  const double terms = sources * (degree + 1.0) * (degree + 2.0) / 2;
  state.counters["s/source"] =
      benchmark::Counter(sources, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["s/term"] =
      benchmark::Counter(terms, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void adjoint(benchmark::State& state) {
  const int degree = static_cast<int>(state.range(0));
  const std::vector<double> weights(directions().size(), 1.0);
  for (auto _ : state) {
    Coefficients sum(degree);
    add_adjoint({.directions = directions(), .weights = weights}, sum, {.engine = Engine::kDirect},
                kOneThread);
    benchmark::DoNotOptimize(sum.values().data());
  }
  count_sources(state, degree);
}
BENCHMARK(adjoint)->Arg(64)->Arg(180)->Arg(256)->Unit(benchmark::kMillisecond);

void values(benchmark::State& state) {
  const Coefficients f = some_coefficients(static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(evaluate(f, directions(), {.engine = Engine::kDirect}, kOneThread));
  count_sources(state, f.degree());
}
BENCHMARK(values)->Arg(64)->Arg(180)->Arg(256)->Unit(benchmark::kMillisecond);

void values_and_gradients(benchmark::State& state) {
  const Coefficients f = some_coefficients(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        evaluate_with_gradient(f, directions(), {.engine = Engine::kDirect}, kOneThread));
  }
  count_sources(state, f.degree());
}
BENCHMARK(values_and_gradients)->Arg(64)->Arg(180)->Unit(benchmark::kMillisecond);

// Measures a mesh of 5 120 triangles to degree 64, with the default precision.
void expand_by(benchmark::State& state, Method method) {
  const StarChart chart = make_star_chart(bumpy_sphere(4));
  std::size_t nodes = 0;
  for (auto _ : state) {
    const Transform transform = expand(chart, {.degree = 64, .method = method}, kOneThread);
    nodes = transform.edge_nodes + transform.face_nodes;
  }
  state.counters["nodes"] = static_cast<double>(nodes);
}
BENCHMARK_CAPTURE(expand_by, edge, Method::kEdge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(expand_by, gauge, Method::kGauge)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(expand_by, curl, Method::kCurl)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(expand_by, area, Method::kArea)->Unit(benchmark::kMillisecond);

void center_of(benchmark::State& state, CenterKind kind) {
  const Mesh mesh = bumpy_sphere(6);
  for (auto _ : state) {
    benchmark::DoNotOptimize(find_center(mesh, {.kind = kind, .rays = 0}, kOneThread));
  }
  state.counters["s/triangle"] =
      benchmark::Counter(static_cast<double>(state.iterations() * mesh.faces.size()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK_CAPTURE(center_of, slope, CenterKind::kSlope)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(center_of, kernel, CenterKind::kKernel)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(center_of, cosine, CenterKind::kCosine)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rholm

BENCHMARK_MAIN();
