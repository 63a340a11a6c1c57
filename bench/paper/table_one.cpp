// Table 1: time and error for each of the paper's objects, and for our Monte Carlo.
//
// Times are processor time of one thread, from the mesh in memory to the coefficients. The centre
// and the pairs of edges are known before.
#include <algorithm>
#include <limits>
#include <vector>

#include "base/stopwatch.h"
#include "expected_error.h"
#include "experiments.h"
#include "rholm/harmonic.h"
#include "rholm/monte_carlo.h"
#include "rholm/primitives.h"
#include "rholm/transform.h"

namespace rholm::paper {
namespace {

// A row of the paper's Table 1. The paper's method was run for an error of 0.001.
struct Row {
  const char* name;
  const char* key;  // part of a file's name
  std::size_t points;
  int degree;
  double seconds, triangle_seconds, triangle_error;
};
constexpr Row kRows[] = {{"Igea", "igea", 135'000, 256, 5.5, 140, 0.012},
                         {"Max-Planck", "max-planck", 200'000, 224, 4.2, 220, 0.01},
                         {"Dinosaur", "dinosaur", 56'000, 350, 4.4, 59, 0.018},
                         {"Tyra", "tyra", 100'000, 320, 6.8, 130, 0.01},
                         {"Buddha", "buddha", 543'000, 450, 10.7, 480, 0.009},
                         {"Thai", "thai", 3'000'000, 480, 20.2, 1200, 0.019},
                         {"Vase", "vase", 68'000, 200, 4.7, 65, 0.031}};
constexpr double kPaperError = 0.001;

Mesh stand_in(const Row& row, std::size_t faces, const Context& context) {
  if (row.key == std::string("vase")) return vase(faces, context);
  return rough_body(faces, 512, row.points, context);  // the number of points is the seed
}

struct Measured {
  double cpu = 0;  // seconds
  double error = 0;
};

// Exact norms, which determine the truncation error, are not needed for the coefficients.
Measured measure_edge(const StarChart& chart, int degree, double precision, int repeat,
                      const Coefficients& exact) {
  Measured result{std::numeric_limits<double>::max(), 0};
  for (int i = 0; i < repeat; ++i) {
    const double begin = cpu_seconds();
    const Transform transform =
        expand(chart, {.degree = degree, .precision = precision}, kOneThread);
    const auto norms = transform.times.find("norms");
    const double cpu =
        cpu_seconds() - begin - (norms == transform.times.end() ? 0 : norms->second.cpu);
    result.cpu = std::min(result.cpu, cpu);
    result.error = radius_error(transform.expansion.coefficients, exact);
  }
  return result;
}

double sampling_cpu(const MonteCarlo& run) {
  double cpu = 0;
  for (const char* stage : {"samples", "sums"}) {
    if (const auto at = run.times.find(stage); at != run.times.end()) cpu += at->second.cpu;
  }
  return cpu;
}

// Returns seconds per point, which do not depend on the mesh.
double cpu_per_point(int degree, SamplePlaces places) {
  const StarChart chart = make_star_chart(bumpy_sphere(3, 0.2));
  const MonteCarlo run =
      monte_carlo(chart, {.degree = degree, .places = places, .samples = 8}, kOneThread);
  return sampling_cpu(run) / static_cast<double>(run.places * run.samples);
}

// Seconds of the longest run. Time and error of longer runs are predicted.
constexpr double kLongestRun = 20;

// Uses two points on each triangle, the smallest possible number.
Json measure_triangles(const StarChart& chart, int degree, double per_point,
                       const Coefficients& exact) {
  const double points = 2 * static_cast<double>(chart.mesh.faces.size());
  Json result = {{"points", points},
                 {"cpu_seconds", points * per_point},
                 {"expected_error", expected_triangle_error(chart, degree, 2) / exact.c(0, 0)}};
  if (points * per_point > kLongestRun) return result;
  const MonteCarlo run = monte_carlo(
      chart, {.degree = degree, .places = SamplePlaces::kTriangles, .samples = 2}, kOneThread);
  result["cpu_seconds"] = sampling_cpu(run);
  result["measured_error"] = radius_error(run.expansion.coefficients, exact);
  return result;
}

// Returns the root mean square of the truncation error over the vertices, over the mean radius:
// (P42) as a mean instead of a sum.
double vertex_error(const StarChart& chart, const Coefficients& exact) {
  std::vector<Vec3> directions;
  directions.reserve(chart.mesh.vertices.size());
  for (const Vec3& x : chart.mesh.vertices) directions.push_back(normalized(x));
  const std::vector<double> radii = evaluate(exact, directions, {.precision = 1e-9});
  double sum = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    sum += std::pow(radii[i] - norm(chart.mesh.vertices[i]), 2);
  }
  const double mean = exact.c(0, 0) / std::sqrt(4 * std::numbers::pi);
  return std::sqrt(sum / static_cast<double>(radii.size())) / mean;
}

Json measure_row(const Row& row, const Settings& settings) {
  std::fprintf(stderr, "Table 1: %s\n", row.name);
  const std::size_t faces = (settings.quick ? row.points / 50 : row.points) * 2;
  const int degree = settings.quick ? row.degree / 10 : row.degree;
  const Subject shape =
      subject(row.name, row.key, settings.data, faces, stand_in(row, faces, {}), "made here", {});
  const StarChart& chart = shape.chart;
  const Transform reference = expand(chart, {.degree = degree, .precision = 1e-11});
  const Coefficients& exact = reference.expansion.coefficients;
  const int repeat = settings.quick ? 1 : 3;
  const Measured coarse = measure_edge(chart, degree, 1e-3, repeat, exact);
  const Measured fine = measure_edge(chart, degree, 1e-6, repeat, exact);
  Json result = {{"name", row.name},
                 {"source", shape.source},
                 {"real", shape.real},
                 {"star_shaped", chart.report.star_shaped},
                 {"points", row.points},
                 {"faces", chart.mesh.faces.size()},
                 {"vertices", chart.mesh.vertices.size()},
                 {"degree", degree},
                 {"paper",
                  {{"cpu_seconds", row.seconds},
                   {"error", kPaperError},
                   {"triangle_cpu_seconds", row.triangle_seconds},
                   {"triangle_error", row.triangle_error}}},
                 {"coarse", {{"cpu_seconds", coarse.cpu}, {"error", coarse.error}}},
                 {"fine", {{"cpu_seconds", fine.cpu}, {"error", fine.error}}},
                 {"vertex_error", vertex_error(chart, exact)}};
  const double per_point = cpu_per_point(degree, SamplePlaces::kTriangles);
  result["triangle_cpu_per_point"] = per_point;
  result["edge_cpu_per_point"] = cpu_per_point(degree, SamplePlaces::kEdges);
  result["triangles"] = measure_triangles(chart, degree, per_point, exact);
  if (reference.truncation_rms && chart.report.star_shaped) {
    result["truncation_rms"] =
        *reference.truncation_rms * std::sqrt(4 * std::numbers::pi) / exact.c(0, 0);
  }
  return result;
}

}  // namespace

Json table_one(const Settings& settings) {
  Json rows = Json::array();
  for (const Row& row : kRows) rows.push_back(measure_row(row, settings));
  return rows;
}

}  // namespace rholm::paper
