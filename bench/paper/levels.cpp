// Figures 1 and 5: levels of detail with their errors. Also makes the picture of Figure 4: a vase
// from points on triangles and from points on edges.
#include <fmt/format.h>

#include <deque>
#include <numeric>
#include <vector>

#include "experiments.h"
#include "rholm/compare.h"
#include "rholm/file.h"
#include "rholm/monte_carlo.h"
#include "rholm/primitives.h"
#include "rholm/render.h"
#include "rholm/synthesize.h"
#include "rholm/transform.h"

namespace rholm::paper {
namespace {

struct Scene {
  std::deque<Mesh> meshes;  // panels point to them
  std::vector<Panel> panels;
  void add(Mesh mesh, const std::string& label, bool smooth) {
    meshes.push_back(std::move(mesh));
    panels.push_back({.mesh = &meshes.back(), .label = label, .scalars = {}, .smooth = smooth});
  }
};

Expansion without_center(Expansion expansion) {
  expansion.center = {};  // a chart's mesh is relative to its centre
  return expansion;
}

struct View {
  Vec3 direction, up;
  int width, height;
};

void draw(const Scene& scene, const View& view, const std::string& file, const Settings& settings) {
  RenderOptions options;
  options.width = view.width;
  options.height = view.height;
  options.view = view.direction;
  options.up = view.up;
  options.occlusion_rays = settings.quick ? 2 : 16;  // smooth shading gives smaller files
  write_png(settings.images / file, render(scene.panels, options));
}

Json level(const Mesh& shape, const Mesh& surface, int degree, const Settings& settings) {
  const Comparison found =
      settings.quick ? compare(shape, surface, {.samples = 10'000}) : compare(shape, surface);
  return {{"degree", degree},
          {"coefficients", (degree + 1) * (degree + 1)},
          {"rms", std::max(found.a_to_b.rms, found.b_to_a.rms) / found.diagonal},
          {"max", found.hausdorff / found.diagonal}};
}

// Vertices are closer together than the shortest wave of the largest degree.
int subdivisions_for(int degree) {
  return degree > 300 ? 8 : degree > 100 ? 7 : degree > 40 ? 6 : 5;
}

Json figure(const std::string& file, const Subject& shape, const std::vector<int>& degrees,
            const View& view, const Settings& settings) {
  std::fprintf(stderr, "Levels of detail: %s\n", shape.name.c_str());
  const int degree = degrees.back();
  const Expansion expansion = without_center(expand(shape.chart, {.degree = degree}).expansion);
  Json levels = Json::array();
  Scene scene;
  std::vector<Mesh> surfaces = synthesize(expansion, icosphere(subdivisions_for(degree)), degrees);
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    levels.push_back(level(shape.chart.mesh, surfaces[i], degrees[i], settings));
    scene.add(std::move(surfaces[i]),
              fmt::format("L = {}: {:.2g} %", degrees[i], 100 * levels[i]["rms"].get<double>()),
              true);
  }
  scene.add(shape.chart.mesh, shape.real ? "the mesh" : "the mesh (a stand-in)", false);
  draw(scene, view, file, settings);
  return {{"file", file},
          {"name", shape.name},
          {"source", shape.source},
          {"real", shape.real},
          {"faces", shape.chart.mesh.faces.size()},
          {"star_shaped", shape.chart.report.star_shaped},
          {"once_share", shape.chart.report.once_share},
          {"levels", levels}};
}

// The total number of points is the same on triangles and on edges.
Json vase_picture(const std::string& file, const View& view, const Settings& settings) {
  std::fprintf(stderr, "Picture of Figure 4\n");
  const std::size_t faces = settings.quick ? 12'000 : 136'000;
  // Half the paper's degree: at 200 this number of points leaves four times as much noise.
  const int degree = settings.quick ? 20 : 100;
  const Subject shape =
      subject("Vase", "vase", settings.data, faces, vase(faces, {}), "made here", {});
  const Coefficients exact = expand(shape.chart, {.degree = degree}).expansion.coefficients;
  Scene scene;
  Json errors;
  const Mesh sphere = icosphere(settings.quick ? 5 : 7);
  for (const SamplePlaces places : {SamplePlaces::kTriangles, SamplePlaces::kEdges}) {
    const bool triangles = places == SamplePlaces::kTriangles;
    const MonteCarlo run = monte_carlo(
        shape.chart, {.degree = degree, .places = places, .samples = triangles ? 24u : 16u});
    const double error = radius_error(run.expansion.coefficients, exact);
    errors[std::string("monte-carlo-") + to_string(places)] = error;
    errors["samples"] = run.places * run.samples;
    scene.add(synthesize(without_center(run.expansion), sphere),
              fmt::format("{}: {:.2g} %", triangles ? "points on triangles" : "points on edges",
                          100 * error),
              true);
  }
  Expansion expansion;
  expansion.coefficients = exact;
  scene.add(synthesize(expansion, sphere), fmt::format("exact, L = {}", degree), true);
  scene.add(shape.chart.mesh, shape.real ? "the mesh" : "the mesh (a stand-in)", false);
  draw(scene, view, file, settings);
  return {{"file", file}, {"degree", degree}, {"source", shape.source}, {"errors", errors}};
}

}  // namespace

Json levels_of_detail(const Settings& settings) {
  const bool quick = settings.quick;
  const int width = quick ? 400 : 1200, height = quick ? 140 : 380;
  const std::size_t faces = quick ? 12'000 : 270'000;
  // Igea replaces the Thai statue, which no single centre sees. A file may have any orientation.
  const Subject first = subject("Figure 1", "igea", settings.data, 0,
                                rough_body(faces, quick ? 40 : 512, 3, {}), "made here", {});
  const Subject fifth = subject("Figure 5", "max-planck", settings.data, 0,
                                rough_body(faces, quick ? 40 : 512, 4, {}), "made here", {});
  const View of_first = {{-0.2, -0.25, -1}, {0, 1, 0}, width, height};
  const View of_fifth = {{-0.2, -0.25, -1}, {0, 1, 0}, width, height};
  // Noise compresses badly, so that the picture is smaller.
  const View of_vase = {{-0.3, 0.9, -0.3}, {0, 0, 1}, width * 7 / 8, height * 7 / 8};
  return {
      {"one", figure("paper-figure-1.png", first,
                     quick ? std::vector{4, 8, 32} : std::vector{24, 64, 480}, of_first, settings)},
      {"five",
       figure("paper-figure-5.png", fifth,
              quick ? std::vector{4, 8, 16, 32} : std::vector{8, 24, 64, 224}, of_fifth, settings)},
      {"four", vase_picture("paper-figure-4.png", of_vase, settings)}};
}

}  // namespace rholm::paper
