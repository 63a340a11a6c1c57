#include "cli/commands/make_sample.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/files/inputs.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "rholm/points.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

// The number of holes and their radius.
std::vector<double> parse_holes(const std::string& option, const std::string& text) {
  const std::vector<double> values = parse_numbers(option, text, 2);
  if (values[0] == std::floor(values[0]) && values[0] >= 0 && values[0] <= 1000 && values[1] >= 0 &&
      values[1] <= 1) {
    return values;
  }
  throw UsageError(fmt::format(
      "{} is '{}'; it must be a whole number 0 ... 1000 and a radius 0 ... 1", option, text));
}

Vec3 parse_axis(const std::string& option, const std::string& text) {
  const Vec3 axis = parse_vector(option, text);
  if (norm(axis) > 0) return axis;
  throw UsageError(fmt::format("{} is '{}', which has no direction", option, text));
}

}  // namespace

Option sample_operand(SampleArguments& arguments) {
  return {.name = "MESH",
          .help = "of sample: file of the mesh to take points of, or - for standard input",
          .target = &arguments.mesh,
          .offer = Offer::kShapes};
}

std::vector<Option> sample_options(SampleArguments& a) {
  return {{.name = "points",
           .value = "N",
           .help = "of sample: how many, before holes; 100000 by default",
           .target = &a.points,
           .min = 1,
           .max = static_cast<double>(kMaxPoints)},
          {.name = "noise",
           .value = "F",
           .help = "of sample: standard deviation of each point along x, y and z, of the diagonal",
           .target = &a.noise,
           .min = 0,
           .max = 1},
          {.name = "normal-noise",
           .value = "DEG",
           .help = "of sample: standard deviation of the angle each normal is turned by, degrees",
           .target = &a.normal_noise,
           .min = 0,
           .max = 180},
          {.name = "outliers",
           .value = "F",
           .help = "of sample: share of the points that is anywhere in the box, grown by 10 %",
           .target = &a.outliers,
           .min = 0,
           .max = 1},
          {.name = "holes",
           .value = "K,R",
           .help = "of sample: without points in K balls about random points of the surface, "
                   "radius R of the diagonal",
           .target = &a.holes,
           .check = parse_holes},
          {.name = "density-ratio",
           .value = "Q",
           .help = "of sample: density falls Q times along the longest axis, exponentially",
           .target = &a.density_ratio,
           .min = 1,
           .max = kMaxDensityRatio},
          {.name = "pattern",
           .value = "WHERE",
           .help = "of sample: random (the default); slices across an axis; rings, planes through "
                   "it; grid, lines along it and across; lines, rays of scanners in rows",
           .target = &a.pattern,
           .choices = {"random", "slices", "rings", "lines", "grid"}},
          {.name = "ratio",
           .value = "R",
           .help = "of sample: steps between the rows of a pattern over those along them; 1 by "
                   "default",
           .target = &a.ratio,
           .min = 1,
           .max = kMaxPatternRatio},
          {.name = "axis",
           .value = "X,Y,Z",
           .help = "of sample: of the pattern; 0,0,1 by default",
           .target = &a.axis,
           .check = parse_axis},
          {.name = "scans",
           .value = "K",
           .help = "of sample: by K scanners all around, each of what it sees, all together as "
                   "many points",
           .target = &a.scans,
           .min = 1,
           .max = kMaxScans},
          {.name = "misalign",
           .value = "F",
           .help = "of sample: rms distance by which the scans are moved, of the diagonal",
           .target = &a.misalign,
           .min = 0,
           .max = 1},
          {.name = "noise-per-scan",
           .value = "F",
           .help = "of sample: the last scan has so much more noise than the first, others between",
           .target = &a.noise_per_scan,
           .min = 0,
           .max = 1},
          {.name = "sensor",
           .help = "of sample: with the place of its scanner at each point (sensor_x, ...)",
           .target = &a.sensor},
          {.name = "largest-component",
           .help = "of sample: of the part of MESH with the largest area only",
           .target = &a.largest_component},
          {.name = "no-normals", .help = "of sample: points only", .target = &a.no_normals}};
}

void refuse_given(const SampleArguments& a, const std::string& kind) {
  const auto refuse = [&](bool given, const char* option) {
    if (given) throw UsageError(fmt::format("a {} has no {}", kind, option));
  };
  refuse(!a.mesh.empty(), "MESH");
  refuse(a.points.has_value(), "--points");
  refuse(a.noise.has_value(), "--noise");
  refuse(a.normal_noise.has_value(), "--normal-noise");
  refuse(a.outliers.has_value(), "--outliers");
  refuse(!a.holes.empty(), "--holes");
  refuse(a.density_ratio.has_value(), "--density-ratio");
  refuse(!a.pattern.empty(), "--pattern");
  refuse(a.ratio.has_value(), "--ratio");
  refuse(!a.axis.empty(), "--axis");
  refuse(a.scans.has_value(), "--scans");
  refuse(a.misalign.has_value(), "--misalign");
  refuse(a.noise_per_scan.has_value(), "--noise-per-scan");
  refuse(a.sensor, "--sensor");
  refuse(a.largest_component, "--largest-component");
  refuse(a.no_normals, "--no-normals");
}

PointCloud make_sample(const SampleArguments& a, std::uint64_t seed, Session& session) {
  if (a.mesh.empty()) throw UsageError("a sample needs a mesh: 'rholm make sample MESH -o OUT'");
  SampleOptions options{.noise = a.noise.value_or(0),
                        .normal_noise = a.normal_noise.value_or(0),
                        .outliers = a.outliers.value_or(0),
                        .density_ratio = a.density_ratio.value_or(1),
                        .pattern_ratio = a.ratio.value_or(1),
                        .scans = a.scans.value_or(0),
                        .misalignment = a.misalign.value_or(0),
                        .scan_noise = a.noise_per_scan.value_or(0),
                        .sensor = a.sensor,
                        .normals = !a.no_normals,
                        .seed = seed};
  if (!a.pattern.empty()) options.pattern = parse_sample_pattern(a.pattern);
  if (!a.axis.empty()) options.pattern_axis = parse_axis("--axis", a.axis);
  const bool rows = options.pattern != SamplePattern::kRandom;
  if (!rows && (a.ratio || !a.axis.empty())) {
    throw UsageError("--ratio and --axis are those of a --pattern");
  }
  if (options.scans == 0) {
    if (options.pattern == SamplePattern::kLines) throw UsageError("lines need --scans K");
    if (a.misalign || a.noise_per_scan || a.sensor) {
      throw UsageError("--misalign, --noise-per-scan and --sensor need --scans K");
    }
  } else if (rows && options.pattern != SamplePattern::kLines) {
    throw UsageError(fmt::format("scans have lines or random points, no {}", a.pattern));
  }
  if (a.points) options.points = static_cast<std::size_t>(*a.points);
  if (!a.holes.empty()) {
    const std::vector<double> holes = parse_holes("--holes", a.holes);
    options.holes = static_cast<int>(holes[0]);
    options.hole_radius = holes[1];
  }
  const Mesh mesh = read_mesh(a.mesh, session);
  return sample_surface(a.largest_component ? largest_component(weld(mesh).mesh) : mesh, options,
                        session.context());
}

}  // namespace rholm::cli
