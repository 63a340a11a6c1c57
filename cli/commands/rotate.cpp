// rholm rotate: rotates or mirrors coefficients.
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/commands/rotation_report.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/align.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::string axis;
  std::optional<double> angle;
  std::string euler;
  std::string matrix;
  bool principal_axes = false;
  std::string mirror;
  std::string about = "origin";
  CoefficientsOutputOptions to;
};

constexpr double kDegrees = std::numbers::pi / 180;

void check_usage(const Options& o) {
  if (o.axis.empty() == o.angle.has_value()) {
    throw UsageError("--axis X,Y,Z and --angle DEG must be given together");
  }
  const int wanted = o.angle.has_value() + !o.euler.empty() + !o.matrix.empty() + o.principal_axes +
                     !o.mirror.empty();
  if (wanted != 1) {
    throw UsageError(
        "give one of --axis with --angle, --euler, --matrix, --principal-axes and --mirror");
  }
}

Rotation parse_matrix(const std::string& option, const std::string& text) {
  const std::vector<double> m = parse_numbers(option, text, 9);
  Rotation rotation;
  check_by(option, text, [&] {
    rotation = rholm::rotation_of(
        RotationMatrix{Vec3{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}});
  });
  return rotation;
}

void check_about(const std::string& option, const std::string& text) {
  if (text != "origin" && text != "center") parse_vector(option, text);
}

Rotation rotation_of(const Options& o, const PrincipalAxes& principal) {
  if (o.angle) return rotation_about(parse_direction("--axis", o.axis), *o.angle * kDegrees);
  if (!o.euler.empty()) {
    const Vec3 e = parse_vector("--euler", o.euler);
    return rholm::rotation_of(EulerAngles{e.x * kDegrees, e.y * kDegrees, e.z * kDegrees});
  }
  if (!o.matrix.empty()) {
    return parse_matrix("--matrix", o.matrix);
  }
  return principal.to_axes;
}

// Reports the axes that degree 2 does not determine.
void report_free_axes(const std::vector<Vec3>& axes, Json& json, std::string& text) {
  json["free_axes"] = Json::array();
  for (const Vec3& axis : axes) {
    json["free_axes"].push_back(json_of(axis));
    text += line("free to turn", "about " + rholm::cli::text_of(axis));
  }
}

Vec3 point_about(const Options& o, const Expansion& expansion) {
  if (o.about == "origin") return {};
  if (o.about == "center") return expansion.center;
  return parse_vector("--about", o.about);
}

int run(const Options& options, Session& session) {
  check_usage(options);
  const CoefficientsOutput output =
      coefficients_output(options.to.output, options.to.format, options.to.json);
  const Convention convention = options.to.convention.output_convention();
  check_writable(options.to.output);
  const Expansion before =
      read_coefficients_input(options.input, session, options.to.input_convention).expansion;
  const Vec3 about = point_about(options, before);
  Json json;
  json["file"] = options.input;
  std::string text = display_name(options.input);
  Expansion after;
  if (!options.mirror.empty()) {
    const Axis axis = options.mirror == "x"   ? Axis::kX
                      : options.mirror == "y" ? Axis::kY
                                              : Axis::kZ;
    after = mirror(before, axis, about);
    json["mirror"] = options.mirror;
    text += fmt::format(": mirrored, {0} to -{0}\n", options.mirror);
  } else {
    PrincipalAxes principal;
    if (options.principal_axes) principal = principal_axes(before.coefficients, before.function);
    const Rotation rotation = rotation_of(options, principal);
    after = rotate(before, rotation, about, session.context());
    json.update(json_of(rotation));
    text += ": rotated\n" + text_of(rotation);
    if (options.principal_axes) report_free_axes(principal.free_axes, json, text);
  }
  json["about"] = json_of(about);
  json["center"] = json_of(after.center);
  text += line("centre", rholm::cli::text_of(after.center));
  text.pop_back();  // the note ends the line
  write_coefficients_output(after, output, convention, session);
  if (options.to.json) {
    print_json(json);
  } else {
    session.note(text);
  }
  return 0;
}

std::vector<Option> turn_options(Options& o) {
  return {
      model_operand(o.input),
      {.name = "axis",
       .value = "X,Y,Z",
       .help = "direction of the rotation axis; with --angle",
       .target = &o.axis,
       .check = parse_direction},
      {.name = "angle",
       .value = "DEG",
       .help = "rotation angle in degrees, counter-clockwise when the axis points to the viewer",
       .target = &o.angle,
       .min = -1e6,
       .max = 1e6},
      {.name = "euler",
       .value = "A,B,C",
       .help = "Euler angles in degrees: rotate by C about z, then by B about y, then by A about z",
       .target = &o.euler,
       .check = parse_vector},
      {.name = "matrix",
       .value = "M",
       .help = "rotation matrix as nine numbers, row by row",
       .target = &o.matrix,
       .check = parse_matrix},
      {.name = "principal-axes",
       .help = "rotate the longest principal axis of degree 2 to x and the shortest to z. If two "
               "axes are equal, only the third is rotated; if all are equal, nothing is",
       .target = &o.principal_axes},
      {.name = "mirror",
       .help = "change the sign of this coordinate instead",
       .target = &o.mirror,
       .choices = {"x", "y", "z"}},
      {.name = "about",
       .value = "POINT",
       .help = "fixed point: origin of the coordinates, center of the expansion, or X,Y,Z; origin "
               "by default",
       .target = &o.about,
       .check = check_about}};
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = turn_options(o);
  append(list, coefficients_output_options(o.to, "file of coefficients to write"));
  return list;
}

}  // namespace

Command rotate_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "rotate",
      .summary = "Rotate or mirror coefficients exactly",
      .description =
          "Rotates a model without making its surface. The coefficients of the rotated shape are "
          "computed from the coefficients of the shape. The rotation is exact up to rounding, and "
          "the errors of the model stay valid.\n\nThe rounding error is 1e-12 at degree 512, where "
          "a rotation takes a tenth of a second. The energy of each degree stays the same. The "
          "centre of the expansion moves with the shape, unless --about center is given.",
      .options = in_groups(option_list(*options), {{Group::kAdvanced, {"matrix", "about"}}}),
      .examples = {"rholm rotate bumpy.h5 --axis 0,0,1 --angle 30 -o turned.h5",
                   "rholm rotate bumpy.h5 --principal-axes --json -o laid.h5",
                   "rholm rotate bumpy.h5 --mirror x -o image.h5"},
      .run = [options](Session& session) { return run(*options, session); },
      .per_shape = PerShape{.extension = "h5"}};
}

}  // namespace rholm::cli
