// Monte Carlo on edges and on triangles, one thread: seconds per sample, and the errors at equal
// total numbers of samples on five shapes. Counters are the relative l2 errors over 1 <= l <= L
// (one seed), and the error on triangles divided by the error on edges.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

#include "base/random.h"
#include "rholm/monte_carlo.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

const Context kOneThread = {.threads = 1, .progress = {}};

Mesh octahedron() {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::size_t i = 0; i < 6; ++i) mesh.vertices[i] *= 0.6 + random_uniform(1, i);
  mesh.faces = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  return mesh;
}

// Returns an elongated body with hills and 6 % of noise from vertex to vertex.
Mesh rough_asteroid() {
  Mesh mesh = bumpy_sphere(4, 0.35, 7);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    Vec3& v = mesh.vertices[i];
    v *= 0.97 + 0.06 * random_uniform(3, i);
    v = {1.8 * v.x, v.y, 0.8 * v.z};
  }
  return mesh;
}

struct Shape {
  const char* name;
  Mesh mesh;
  Vec3 center;
};

const Shape& shape(std::size_t i) {
  static const std::array<Shape, 5> shapes = {
      Shape{"sphere off centre, 5120 faces", icosphere(4), {0.2, 0.1, 0.2}},
      Shape{"bumpy sphere, 5120 faces", bumpy_sphere(4, 0.2), {}},
      Shape{"octahedron, 8 faces", octahedron(), {}},
      Shape{"box, 12 faces", box({2, 1.5, 1}), {0.01, 0.02, 0.03}},
      Shape{"rough asteroid, 5120 faces", rough_asteroid(), {}}};
  return shapes[i];
}

StarChart chart_of(const Shape& s) {
  return make_star_chart(s.mesh,
                         {.center = {.kind = CenterKind::kGiven, .point = s.center, .rays = 0}});
}

double relative_error(const Coefficients& a, const Coefficients& b) {
  Coefficients difference = a;
  for (std::size_t i = 0; i < a.values().size(); ++i) difference.values()[i] -= b.values()[i];
  const std::vector<double> errors = power_spectrum(difference), norms = power_spectrum(b);
  double error = 0, norm = 0;
  for (std::size_t l = 1; l < norms.size(); ++l) {
    error += errors[l];
    norm += norms[l];
  }
  return std::sqrt(error / norm);
}

// 16 points on each edge and 24 on each triangle: there are three edges per two triangles.
void edges_against_triangles(benchmark::State& state) {
  const Shape& s = shape(static_cast<std::size_t>(state.range(0)));
  const int degree = static_cast<int>(state.range(1));
  state.SetLabel(s.name);
  const StarChart chart = chart_of(s);
  const Coefficients exact =
      expand(chart, {.degree = degree, .precision = 1e-10}, kOneThread).expansion.coefficients;
  double edges = 0, triangles = 0;
  for (auto _ : state) {
    const auto error = [&](SamplePlaces places, std::size_t samples) {
      const MonteCarlo run =
          monte_carlo(chart, {.degree = degree, .places = places, .samples = samples}, kOneThread);
      return relative_error(run.expansion.coefficients, exact);
    };
    edges = error(SamplePlaces::kEdges, 16);
    triangles = error(SamplePlaces::kTriangles, 24);
  }
  state.counters["edges"] = edges;
  state.counters["triangles"] = triangles;
  state.counters["times_less"] = triangles / edges;
}
BENCHMARK(edges_against_triangles)
    ->ArgsProduct({{0, 1, 2, 3, 4}, {32, 128}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void samples(benchmark::State& state) {
  const StarChart chart = chart_of(shape(1));
  const auto places = static_cast<SamplePlaces>(state.range(0));
  state.SetLabel(to_string(places));
  double drawn = 0;
  for (auto _ : state) {
    const MonteCarlo run = monte_carlo(
        chart, {.degree = static_cast<int>(state.range(1)), .places = places, .samples = 2},
        kOneThread);
    drawn += static_cast<double>(run.places * run.samples);
  }
  state.counters["s/sample"] =
      benchmark::Counter(drawn, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(samples)->ArgsProduct({{0, 1}, {32, 64, 128, 256}})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace rholm

BENCHMARK_MAIN();
