// rholm make: test shapes and samples.
#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/commands/make_sample.h"
#include "cli/files/outputs.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/session.h"
#include "rholm/primitives.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string kind;
  SampleArguments sample;
  std::optional<int> subdivisions;
  std::string axes;
  std::string size;
  std::optional<int> cells;
  std::string radii;
  std::string segments;
  std::optional<double> amplitude;
  std::optional<int> seed;
  std::string translate;
  std::string output;
  std::string format;
  bool ascii = false;
};

constexpr int kDefaultSubdivisions = 5;  // 10 242 vertices: smooth to look at, fast to work with

// Refuses options that do not belong to the kind of shape, which would otherwise be ignored.
void check_options(const Options& o) {
  const auto only_for = [&](bool given, const char* option, std::vector<std::string> kinds) {
    if (!given || std::find(kinds.begin(), kinds.end(), o.kind) != kinds.end()) return;
    throw UsageError(fmt::format("{1} does not apply to '{0}'", o.kind, option));
  };
  only_for(o.subdivisions.has_value(), "--subdivisions", {"sphere", "ellipsoid", "bumpy"});
  only_for(!o.axes.empty(), "--axes", {"ellipsoid"});
  only_for(!o.size.empty(), "--size", {"box"});
  only_for(o.cells.has_value(), "--cells", {"box"});
  only_for(!o.radii.empty(), "--radii", {"torus"});
  only_for(!o.segments.empty(), "--segments", {"torus"});
  only_for(o.amplitude.has_value(), "--amplitude", {"bumpy"});
  only_for(o.seed.has_value(), "--seed", {"bumpy", "sample"});
  if (o.kind != "sample") refuse_given(o.sample, o.kind);
}

// Parses three lengths.
Vec3 parse_edges(const std::string& option, const std::string& text) {
  const std::vector<double> edges = parse_positive(option, text, 3);
  return {edges[0], edges[1], edges[2]};
}

std::vector<double> parse_radii(const std::string& option, const std::string& text) {
  std::vector<double> radii = parse_positive(option, text, 2);
  if (radii[0] > radii[1]) return radii;
  throw UsageError(
      fmt::format("{} is '{}'; the first radius, of the centre line, must be larger than the "
                  "radius of the tube, for example 1,0.4",
                  option, text));
}

std::array<int, 2> parse_segments(const std::string& option, const std::string& text) {
  return parse_grid(option, text, {3, 3});
}

Mesh make_torus(const Options& o) {
  const std::vector<double> radii =
      o.radii.empty() ? std::vector<double>{1, 0.4} : parse_radii("--radii", o.radii);
  const auto segments =
      o.segments.empty() ? std::array<int, 2>{96, 48} : parse_segments("--segments", o.segments);
  return torus(radii[0], radii[1], segments[0], segments[1]);
}

Mesh make_shape(const Options& o) {
  const int subdivisions = o.subdivisions.value_or(kDefaultSubdivisions);
  if (o.kind == "sphere") return icosphere(subdivisions);
  if (o.kind == "ellipsoid") {
    return ellipsoid(o.axes.empty() ? Vec3{3, 2, 1} : parse_edges("--axes", o.axes), subdivisions);
  }
  if (o.kind == "box") {
    return box(o.size.empty() ? Vec3{1, 1, 1} : parse_edges("--size", o.size), o.cells.value_or(1));
  }
  if (o.kind == "torus") return make_torus(o);
  return bumpy_sphere(subdivisions, o.amplitude.value_or(0.2),
                      static_cast<std::uint64_t>(o.seed.value_or(1)));
}

int run(const Options& options, Session& session) {
  check_options(options);
  const ShapeFormat format = options.kind == "sample"
                                 ? points_output(options.output, options.format)
                                 : mesh_output(options.output, options.format);
  check_writable(options.output);
  const Vec3 shift =
      options.translate.empty() ? Vec3{} : parse_vector("--translate", options.translate);
  const ShapeWriteOptions writing{format, options.ascii};
  if (options.kind == "sample") {
    const auto seed = static_cast<std::uint64_t>(options.seed.value_or(1));
    PointCloud cloud = make_sample(options.sample, seed, session);
    for (Vec3& point : cloud.points) point += shift;
    stop_if_interrupted();
    write_shape_output(cloud, options.output, writing, session);
    note_attributes_left_out(cloud.attributes, format, options.output, session);
    return 0;
  }
  Mesh mesh = make_shape(options);
  for (Vec3& vertex : mesh.vertices) vertex += shift;
  stop_if_interrupted();
  write_shape_output(mesh, options.output, writing, session);
  return 0;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> options = {
      {.name = "KIND",
       .help = "sphere, ellipsoid, box, torus, bumpy, or sample for random points of MESH",
       .target = &o.kind,
       .required = true,
       .choices = {"sphere", "ellipsoid", "box", "torus", "bumpy", "sample"}},
      sample_operand(o.sample),
      {.name = "subdivisions",
       .value = "N",
       .help = "for sphere, ellipsoid and bumpy: number of vertices, 10 4^N + 2; 5 by default",
       .target = &o.subdivisions,
       .min = 0,
       .max = 12},
      {.name = "axes",
       .value = "A,B,C",
       .help = "semi-axes of the ellipsoid; 3,2,1 by default",
       .target = &o.axes,
       .check = parse_edges},
      {.name = "size",
       .value = "X,Y,Z",
       .help = "edges of the box; 1,1,1 by default",
       .target = &o.size,
       .check = parse_edges},
      {.name = "cells",
       .value = "N",
       .help = "squares along each edge of the box; 1 by default",
       .target = &o.cells,
       .min = 1,
       .max = 4096},
      {.name = "radii",
       .value = "R,r",
       .help = "radii of the torus: centre line and tube; 1,0.4 by default",
       .target = &o.radii,
       .check = parse_radii},
      {.name = "segments",
       .value = "NxM",
       .help = "faces of the torus around its axis and around its tube; 96x48 by default",
       .target = &o.segments,
       .check = parse_segments},
      {.name = "amplitude",
       .value = "A",
       .help = "height of the bumps of bumpy; 0.2 by default",
       .target = &o.amplitude,
       .min = 0,
       .max = 0.99},
      {.name = "seed",
       .value = "S",
       .help = "seed of the random bumps or points; 1 by default",
       .target = &o.seed,
       .min = 0},
      {.name = "translate",
       .value = "X,Y,Z",
       .help = "vector by which the shape is moved; 0,0,0 by default",
       .target = &o.translate,
       .check = parse_vector}};
  for (Option& option : sample_options(o.sample)) options.push_back(std::move(option));
  options.push_back(output_option(
      o.output, fmt::format("file to write: {}; - for standard output", extensions_by_holding())));
  options.push_back(format_option(o.format, shape_format_names()));
  options.push_back(ascii_option(o.ascii));
  return options;
}

}  // namespace

Command make_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "make",
      .summary = "Make a test shape or sample points from a mesh",
      .description =
          "Writes a closed mesh with a known shape. The shapes are a unit sphere, an ellipsoid, a "
          "box, a torus (not star-shaped) and a bumpy sphere (star-shaped). The words 'make sample "
          "MESH' write points of a mesh instead, as a scanner would measure them.\n\nThe sampled "
          "points are random and "
          "uniform by area, or in the rows of a --pattern, or as --scans scanners around the mesh "
          "see them. They have the normals of the faces. Noise, gaps and variable density are "
          "random numbers of --seed. Colours and other attributes of the mesh are interpolated. "
          "Lengths are fractions of the diagonal of its bounding box.",
      .options =
          in_groups(option_list(*options), {{Group::kAccuracy, {"subdivisions", "points"}},
                                            {Group::kAdvanced,
                                             {"seed", "translate", "cells", "radii", "segments",
                                              "holes", "largest-component", "no-normals"}}}),
      .examples = {"rholm make bumpy -o bumpy.ply",
                   "rholm make ellipsoid --axes 3,2,1 --subdivisions 6 -o ellipsoid.ply",
                   "rholm make sample bumpy.ply --points 20000 --noise 0.002 -o points.ply",
                   "rholm make sample bumpy.ply --pattern slices --pattern-ratio 5 -o slices.ply",
                   "rholm make sample bumpy.ply --scans 8 --sensor -o scans.ply"},
      .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
