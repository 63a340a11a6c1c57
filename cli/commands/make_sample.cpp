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

// Parses the number of holes and their radius.
std::vector<double> parse_holes(const std::string& option, const std::string& text) {
  const std::vector<double> values = parse_numbers(option, text, 2);
  if (values[0] == std::floor(values[0]) && values[0] >= 0 && values[0] <= 1000 && values[1] >= 0 &&
      values[1] <= 1) {
    return values;
  }
  throw UsageError(
      fmt::format("{} is '{}'; it must be a whole number within 0 ... 1000 and a radius within 0 "
                  "... 1, for example 5,0.1",
                  option, text));
}

}  // namespace

Option sample_operand(SampleArguments& arguments) {
  return {.name = "MESH",
          .help = "for sample: file of the mesh, or - for standard input",
          .target = &arguments.mesh,
          .offer = Offer::kShapes};
}

std::vector<Option> sample_options(SampleArguments& a) {
  std::vector<Option> list = field_options(a.options);
  append(
      list,
      {{.name = "holes",
        .value = "K,R",
        .help = "leave out the points in K balls around random points of the surface, of radius R",
        .target = &a.holes,
        .check = parse_holes},
       {.name = "largest-component",
        .help = "use only the component of MESH with the largest area",
        .target = &a.largest_component},
       {.name = "no-normals", .help = "write points without normals", .target = &a.no_normals}});
  for (Option& option : list) option.help = "for sample: " + option.help;
  return list;
}

void refuse_given(const SampleArguments& a, const std::string& kind) {
  const auto refuse = [&](bool given, const std::string& option) {
    if (given) throw UsageError(fmt::format("{1} does not apply to '{0}'", kind, option));
  };
  refuse(!a.mesh.empty(), "MESH");
  for_each_field<SampleOptions>([&](auto, const FieldInfo& info) {
    refuse(a.options.has(info.name), "--" + option_name(info));
  });
  refuse(a.options.values.sensor, "--sensor");
  refuse(!a.holes.empty(), "--holes");
  refuse(a.largest_component, "--largest-component");
  refuse(a.no_normals, "--no-normals");
}

PointCloud make_sample(const SampleArguments& a, std::uint64_t seed, Session& session) {
  if (a.mesh.empty()) throw UsageError("a sample needs a mesh: 'rholm make sample MESH -o OUT'");
  SampleOptions options = a.options.values;
  options.normals = !a.no_normals;
  options.seed = seed;
  const bool rows = options.pattern != SamplePattern::kRandom;
  if (!(norm(options.pattern_axis) > 0))
    throw UsageError("--pattern-axis is 0,0,0; it must be a direction");
  if (!rows && (a.options.has("pattern_ratio") || a.options.has("pattern_axis"))) {
    throw UsageError("--pattern-ratio and --pattern-axis need --pattern");
  }
  if (options.scans == 0) {
    if (options.pattern == SamplePattern::kLines)
      throw UsageError("--pattern lines needs --scans K");
    if (a.options.has("misalignment") || a.options.has("scan_noise") || options.sensor) {
      throw UsageError("--misalignment, --scan-noise and --sensor need --scans K");
    }
  } else if (rows && options.pattern != SamplePattern::kLines) {
    throw UsageError(fmt::format("--scans needs the pattern random or lines, and --pattern is {}",
                                 to_string(options.pattern)));
  }
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
