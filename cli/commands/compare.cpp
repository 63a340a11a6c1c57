// rholm compare: how far two surfaces lie apart.
#include "rholm/compare.h"

#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/length_units.h"
#include "cli/files/surfaces.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string a;
  std::string b;
  CompareOptions compare;
  std::optional<int> subdivisions;
  InputConvention convention;
  bool json = false;
};

Json json_of(const Distances& distances, double unit) {
  return {{"rms", distances.rms / unit},
          {"mean", distances.mean / unit},
          {"max", distances.max / unit}};
}

Json report_json(const Options& options, const Comparison& c) {
  Json json;
  json["a"] = options.a;
  json["b"] = options.b;
  json["samples"] = c.samples;
  json["seed"] = c.seed;
  json["diagonal"] = c.diagonal;
  json["a_to_b"] = json_of(c.a_to_b, 1);
  json["b_to_a"] = json_of(c.b_to_a, 1);
  json["hausdorff"] = c.hausdorff;
  json["threshold"] = c.threshold;
  json["precision"] = c.precision;
  json["recall"] = c.recall;
  json["f_score"] = c.f_score;
  json["normal_median_degrees"] = c.normal_median_degrees;
  json["normal_mean_degrees"] = c.normal_mean_degrees;
  json["relative"] = {{"a_to_b", json_of(c.a_to_b, c.diagonal)},
                      {"b_to_a", json_of(c.b_to_a, c.diagonal)},
                      {"hausdorff", c.hausdorff / c.diagonal},
                      {"threshold", c.threshold / c.diagonal}};
  return json;
}

std::string distances_line(const std::string& name, const Distances& d, double diagonal) {
  return line(
      name, fmt::format("{:>11.4e} {:>11.4e} {:>11.4e}   {:>9.3e} {:>9.3e} {:>9.3e}", d.rms, d.mean,
                        d.max, d.rms / diagonal, d.mean / diagonal, d.max / diagonal));
}

std::string report_text(const Options& options, const Comparison& c) {
  std::string text =
      fmt::format("A is {}, B is {}\n", display_name(options.a), display_name(options.b));
  text += line("", fmt::format("{:>11} {:>11} {:>11}   {:>9} {:>9} {:>9}", "rms", "mean", "max",
                               "rms/diag", "mean/diag", "max/diag"));
  text += distances_line("A to B", c.a_to_b, c.diagonal);
  text += distances_line("B to A", c.b_to_a, c.diagonal);
  text += line("Hausdorff", fmt::format("{} ({:.3e} of the diagonal {})", text_of(c.hausdorff),
                                        c.hausdorff / c.diagonal, text_of(c.diagonal)));
  text += line("F-score", fmt::format("{:.6g} within {} (precision {:.6g}, recall {:.6g})",
                                      c.f_score, text_of(c.threshold), c.precision, c.recall));
  text += line("normals", fmt::format("{:.4g} degrees apart in the median, {:.4g} in the mean",
                                      c.normal_median_degrees, c.normal_mean_degrees));
  text += line("samples", fmt::format("{} on each, seed {}", c.samples, c.seed));
  return text;
}

int run(const Options& options, Session& session) {
  Input first = read_surface_input(options.a, session, options.convention);
  Input second = read_surface_input(options.b, session, options.convention);
  CommonUnit unit;
  unit.add(first, options.a, session);
  unit.add(second, options.b, session);
  const Mesh a = surface_of(first, options.a, {}, options.subdivisions, session);
  const Mesh b = surface_of(second, options.b, {}, options.subdivisions, session);
  const Comparison comparison = compare(a, b, options.compare, session.context());
  if (options.json) {
    print_json(report_json(options, comparison));
  } else {
    print_text(report_text(options, comparison));
  }
  return 0;
}

std::vector<Option> option_list(Options& o) {
  const auto surface = [](const char* name, const char* help, std::string& target) {
    return Option{.name = name,
                  .help = help,
                  .target = &target,
                  .required = true,
                  .offer = Offer::kShapesAndCoefficients};
  };
  std::vector<Option> list = {
      surface("A", "the surface to measure against: a mesh, or coefficients", o.a),
      surface("B", "the other surface", o.b),
      {.name = "samples",
       .value = "N",
       .help = "points on each surface; 200000 by default",
       .target = &o.compare.samples,
       .min = 1,
       .max = 1e9},
      {.name = "seed",
       .value = "S",
       .help = "of the random points; 1 by default",
       .target = &o.compare.seed},
      {.name = "threshold",
       .value = "T",
       .help = "of the F-score, as a fraction of A's diagonal; 0.01 by default",
       .target = &o.compare.threshold,
       .min = 1e-12,
       .max = 1e3},
      {.name = "subdivisions",
       .value = "N",
       .help = "icosphere on which coefficients are sampled; by default the smallest N of 5 "
               "... 8 with 16 (L+1)^2 vertices",
       .target = &o.subdivisions,
       .min = 0,
       .max = 12}};
  append(list, input_convention_options(o.convention));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command compare_command() {
  auto options = std::make_shared<Options>();
  return {.name = "compare",
          .summary = "How far two surfaces lie apart",
          .description =
              "Distances from random points of each surface, evenly spread over its area, to the "
              "exact closest points of the other: rms, mean and largest, in the shape's unit and "
              "as fractions of the diagonal of A's bounding box; the angle between oriented "
              "normals; the F-score, the harmonic mean of the shares of points within a "
              "threshold.\n\nThe largest distance is a lower bound of the Hausdorff distance.",
          .options = option_list(*options),
          .examples = {"rholm compare bumpy.ply bumpy.h5",
                       "rholm compare bumpy.ply smooth.ply --samples 300000 --seed 7 --json"},
          .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
