// Figure 4: the error of points on edges and of points on triangles at the same number of points.
// Points are random, or nodes of Gauss rules.
#include <vector>

#include "experiments.h"
#include "fixed_nodes.h"
#include "paper/monte_carlo/edge_terms.h"
#include "rholm/monte_carlo.h"
#include "rholm/primitives.h"
#include "rholm/transform.h"
#include "transform/geometry/star_geometry.h"
#include "transform/rules/bernstein_rules.h"

namespace rholm::paper {
namespace {

struct Case {
  Subject shape;
  int degree;
  std::size_t most_points;  // random points in total: a minute or so
  std::size_t most_nodes;
};

std::vector<Case> cases(const Settings& settings) {
  const bool quick = settings.quick;
  const Data& data = settings.data;
  std::vector<Case> list;
  const int degree = quick ? 16 : 64;
  const std::size_t few = quick ? 20'000 : 300'000, many = quick ? 100'000 : 4'000'000;
  list.push_back(
      {subject_of("Box", "made here", box({2, 1.5, 1}), {0.01, 0.02, 0.03}, {}), degree, few, few});
  list.push_back({subject_of("Octahedron", "made here, random radii", octahedron(), {}, {}), degree,
                  few, few});
  list.push_back(
      {subject_of("Box, divided", "made here", box({2, 1.5, 1}, 16), {0.01, 0.02, 0.03}, {}),
       degree, many, many});
  list.push_back({subject_of("Bumpy sphere", "made here", bumpy_sphere(quick ? 2 : 4, 0.2), {}, {}),
                  degree, many, many});
  list.push_back({subject("Bennu", "bennu", data, 0, rough_asteroid(quick ? 2 : 4),
                          "made here: a rough asteroid", {}),
                  degree, many, many});
  if (!data.folder.empty()) {
    Subject igea = subject("Igea", "igea", data, 0, bumpy_sphere(1), "made here", {});
    if (igea.real) list.push_back({std::move(igea), degree, 2 * many, many});
  }
  const std::size_t faces = quick ? 3'000 : 136'000;
  list.push_back({subject("Vase", "vase", data, faces, vase(faces, {}), "made here", {}),
                  quick ? 20 : 100, 2 * many, many / 3});
  return list;
}

Json point(std::size_t samples, double error) { return {{"samples", samples}, {"error", error}}; }

// Uses `on_edge` points on each edge, or one and a half times as many on each triangle: there are
// two triangles per three edges.
Json random_points(const Case& c, SamplePlaces places, const Coefficients& exact) {
  Json series = Json::array();
  const std::size_t edges = c.shape.chart.edges.size();
  for (std::size_t on_edge = 4; on_edge * edges <= c.most_points; on_edge *= 4) {
    // With few faces, errors scatter from seed to seed.
    const std::uint64_t seeds = on_edge * edges < 20'000 ? 8 : 1;
    double squares = 0;
    std::size_t drawn = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const bool triangles = places == SamplePlaces::kTriangles;
      const MonteCarlo run =
          monte_carlo(c.shape.chart, {.degree = c.degree,
                                      .places = places,
                                      .seed = seed,
                                      .samples = triangles ? on_edge * 3 / 2 : on_edge});
      squares += std::pow(radius_error(run.expansion.coefficients, exact), 2);
      drawn = run.places * run.samples;
    }
    series.push_back(point(drawn, std::sqrt(squares / static_cast<double>(seeds))));
  }
  return series;
}

Coefficients unscaled(Coefficients f, const StarGeometry& geometry) {
  for (double& value : f.values()) value /= geometry.scale;
  return f;
}

// Smallest error of the plot: nodes converge so fast that smaller errors show nothing new.
constexpr double kSmallest = 1e-9;

Json edge_nodes(const Case& c, const StarGeometry& geometry, const Coefficients& exact) {
  Json series = Json::array();
  // There are more edges than in the mesh, because faces that contain a pole are cut there.
  const std::size_t edges = field_edges(geometry).edges.size();
  for (int n = 1; n * edges <= c.most_nodes; n = std::max(n + 1, n * 4 / 3)) {
    const double error =
        radius_error(unscaled(edge_rule_sum(geometry, c.degree, n, {}), geometry), exact);
    series.push_back(point(n * edges, error));
    if (error < kSmallest) break;
  }
  return series;
}

Json triangle_nodes(const Case& c, const StarGeometry& geometry, const Coefficients& exact) {
  Json series = Json::array();
  std::size_t before = 0;
  for (int exactness = 1; exactness <= kMaxExactness;
       exactness = std::max(exactness + 1, exactness * 8 / 7)) {
    const std::size_t n = triangle_rule_points(exactness);
    if (n * geometry.faces.size() > c.most_nodes) break;
    if (n == before) continue;
    before = n;
    const double error = radius_error(
        unscaled(triangle_rule_sum(geometry, c.degree, exactness, {}), geometry), exact);
    series.push_back(point(n * geometry.faces.size(), error));
    if (error < kSmallest) break;
  }
  return series;
}

// Returns the error ratio of random points on triangles and on edges, degree by degree, at the same
// total number of points. It depends on the number of waves per face.
Json by_degree(const Settings& settings) {
  const struct {
    const char* name;
    Mesh mesh;
    Vec3 center;
  } bodies[] = {{"Octahedron", octahedron(), {}},
                {"Box", box({2, 1.5, 1}), {0.01, 0.02, 0.03}},
                {"Bumpy sphere", bumpy_sphere(2, 0.2), {}},
                {"Bumpy sphere", bumpy_sphere(4, 0.2), {}},
                {"Vase", vase(settings.quick ? 3'000 : 136'000, {}), {}}};
  const std::vector<int> degrees =
      settings.quick ? std::vector{4, 16} : std::vector{4, 16, 64, 256, 1024};
  Json result = Json::array();
  for (const auto& body : bodies) {
    Case c{subject_of(body.name, "made here", body.mesh, body.center, {}), 0, 0, 0};
    c.most_points = 4 * c.shape.chart.edges.size();  // four points on each edge
    Json ratios = Json::array();
    for (const int degree : degrees) {
      // Random points use direct sums, which take minutes.
      if (c.most_points * degree * degree > std::size_t{100'000'000'000}) break;
      std::fprintf(stderr, "Figure 4: %s, degree %d\n", body.name, degree);
      c.degree = degree;
      const Coefficients exact =
          expand(c.shape.chart, {.degree = degree, .precision = 1e-10}).expansion.coefficients;
      const Json triangles = random_points(c, SamplePlaces::kTriangles, exact)[0];
      const Json edges = random_points(c, SamplePlaces::kEdges, exact)[0];
      ratios.push_back({{"triangles", triangles}, {"edges", edges}});
    }
    result.push_back(
        {{"name", body.name}, {"faces", c.shape.chart.mesh.faces.size()}, {"ratios", ratios}});
  }
  return {{"degrees", degrees}, {"bodies", result}};
}

}  // namespace

Json figure_four(const Settings& settings) {
  Json result = Json::array(), degrees = by_degree(settings);
  for (const Case& c : cases(settings)) {
    std::fprintf(stderr, "Figure 4: %s\n", c.shape.name.c_str());
    const StarChart& chart = c.shape.chart;
    const Coefficients exact =
        expand(chart, {.degree = c.degree, .precision = 1e-12}).expansion.coefficients;
    const StarGeometry geometry = star_geometry(chart);
    result.push_back({{"name", c.shape.name},
                      {"source", c.shape.source},
                      {"real", c.shape.real},
                      {"faces", chart.mesh.faces.size()},
                      {"degree", c.degree},
                      {"random_edges", random_points(c, SamplePlaces::kEdges, exact)},
                      {"random_triangles", random_points(c, SamplePlaces::kTriangles, exact)},
                      {"nodes_edges", edge_nodes(c, geometry, exact)},
                      {"nodes_triangles", triangle_nodes(c, geometry, exact)}});
  }
  return {{"shapes", result}, {"by_degree", degrees}};
}

}  // namespace rholm::paper
