// rholm align: turn one model onto another.
#include "rholm/align.h"

#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/commands/rotation_report.h"
#include "cli/files/inputs.h"
#include "cli/files/length_units.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/parse.h"
#include "cli/options/field_options.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string a, b;
  AlignOptions align;
  AlignCenters centers = AlignCenters::kAuto;
  CoefficientsOutputOptions to;
};

Json json_of_aligned(const AlignedRotation& r) {
  Json json = json_of(r.rotation);
  json["mirrored"] = r.mirrored;
  json["correlation"] = r.correlation;
  json["distance"] = r.distance;
  return json;
}

Placement placement_of(const Options& o, const Expansion& a, const Expansion& b, Session& session) {
  Placement placement = align(a, b, o.centers, o.align, session.context());
  if (!placement.why_own.empty()) {
    session.warn(fmt::format("the models' own centres are taken: {}", placement.why_own));
  }
  return placement;
}

Json report_json(const Options& o, const Placement& placement, const Expansion& a,
                 const Expansion& b) {
  const Alignment& found = placement.alignment;
  Json json;
  json["files"] = {o.a, o.b};
  json["start"] = to_string(o.align.start);
  json.update(json_of_aligned(found.best));
  json["unaligned_distance"] = found.unaligned_distance;
  json["descriptor_distance"] = descriptor_distance(a.coefficients, b.coefficients);
  json["from"] = json_of(placement.from);
  json["to"] = json_of(placement.to);
  json["centers"] = to_string(placement.centers);
  // The reflection comes first: p becomes p - 2 ((p - point) . normal) normal.
  json["reflection"] = found.best.mirrored
                           ? Json{{"point", json_of(placement.from)}, {"normal", {1, 0, 0}}}
                           : Json(nullptr);
  json["ambiguities"] = Json::array();
  for (const AlignedRotation& r : found.ambiguities) {
    json["ambiguities"].push_back(json_of_aligned(r));
  }
  json["free_axes"] = Json::array();
  for (const Vec3& axis : found.free_axes) json["free_axes"].push_back(json_of(axis));
  return json;
}

std::string report_text(const Options& o, const Placement& placement) {
  const Alignment& found = placement.alignment;
  std::string text = fmt::format("{} onto {}\n", display_name(o.a), display_name(o.b));
  if (found.best.mirrored) {
    text += line("mirrored",
                 fmt::format("in the plane x = {}, then turned", text_of(placement.from.x)));
  }
  text += text_of(found.best.rotation);
  text += line("about", text_of(placement.from) + ", laid on " + text_of(placement.to));
  text += line("correlation", fmt::format("{:.6f}", found.best.correlation));
  text += line("distance",
               fmt::format("{} rms over solid angle ({} unaligned)", text_of(found.best.distance),
                           text_of(found.unaligned_distance)));
  for (const AlignedRotation& r : found.ambiguities) {
    text += line("nearly as good", fmt::format("{}{}, distance {}", r.mirrored ? "mirrored, " : "",
                                               turn_text(r.rotation), text_of(r.distance)));
  }
  for (const Vec3& axis : found.free_axes) {
    text += line("free to turn", "about " + text_of(axis));
  }
  return text;
}

int run(const Options& options, Session& session) {
  std::optional<CoefficientsOutput> output;
  if (!options.to.output.empty()) {
    output = coefficients_output(options.to.output, options.to.format, options.to.json);
  }
  const Convention convention = options.to.convention.output_convention();
  check_writable(options.to.output);
  if (options.a == "-" && options.b == "-") {
    throw UsageError("only one of the two models can be standard input");
  }
  Expansion a = read_expansion(options.a, session, options.to.input_convention);
  const Expansion b = read_expansion(options.b, session, options.to.input_convention);
  if (a.function != b.function) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} is of the {}, {} of the {}: expand both by the same method",
                            display_name(options.a), to_string(a.function), display_name(options.b),
                            to_string(b.function)));
  }
  bring_to_unit(a, options.a, b.unit, options.b, session);
  const Placement found = placement_of(options, a, b, session);
  if (output) {
    write_coefficients_output(placed(a, found, session.context()), *output, convention, session);
  }
  if (options.to.json) {
    print_json(report_json(options, found, a, b));
  } else if (!output) {
    print_text(report_text(options, found));
  } else if (options.to.output != "-") {
    session.report(report_text(options, found));
  }
  return 0;
}

std::vector<Option> models(Options& o) {
  return {{.name = "A",
           .help = "file of coefficients to rotate, or - for standard input",
           .target = &o.a,
           .required = true,
           .offer = Offer::kCoefficients},
          {.name = "B",
           .help = "file of coefficients that A is rotated onto",
           .target = &o.b,
           .required = true,
           .offer = Offer::kCoefficients}};
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = models(o);
  append(list, field_options(o.align));
  list.push_back(field_option(
      {.name = "centers",
       .help = "points that are moved onto each other: volume, the centroids of the solids; own, "
               "the centres of the expansions; auto, the centroids if both surfaces are visible "
               "from there, and otherwise their own centres, with a warning"},
      o.centers));
  append(list, coefficients_output_options(o.to, "file for the rotated coefficients of A", false));
  return list;
}

}  // namespace

Command align_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "align",
      .summary = "Rotate one model onto another",
      .description =
          "Moves the centroid of A to the centroid of B and finds the rotation that brings the "
          "surfaces closest. The distance is the root mean square difference of the radii over all "
          "directions. The size is not changed.\n\nThe search maximises the correlation over all "
          "rotations, and Newton's iteration refines the result. The report lists other rotations "
          "that are nearly as good, for symmetric shapes. It also lists axes about which the shape "
          "can turn freely: one for a surface of revolution, three for a sphere. A model whose "
          "deviation from a sphere is below its error is treated as a sphere and is not "
          "rotated.\n\nWith --mirror the mirror image of A is tried as well. It is a reflection "
          "across the x axis in the plane through the centroid of A: x becomes 2 from_x - x. The "
          "rotation follows. The reflection is not an inversion in a point.",
      .options = in_groups(option_list(*options),
                           {{Group::kData, {"mirror"}}, {Group::kAdvanced, {"centers"}}}),
      .examples = {"rholm align bumpy.h5 turned.h5",
                   "rholm align image.h5 bumpy.h5 --mirror --json -o back.h5"},
      .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
