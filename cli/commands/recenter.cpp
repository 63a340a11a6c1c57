// rholm recenter: the same surface, expanded about another point.
#include "rholm/recenter.h"

#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/prepare.h"
#include "cli/files/surfaces.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/align.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::string center = "volume";
  CoefficientsOutputOptions to;
};

// Returns the wanted centre. The centroid and the origin follow from the expansion; other centres
// are computed on a fine mesh of its surface.
Vec3 wanted_center(const Options& o, const CenterOptions& wanted, const Expansion& before,
                   Session& session) {
  switch (wanted.kind) {
    case CenterKind::kGiven:
      return wanted.point;
    case CenterKind::kNone:
      return {};
    case CenterKind::kVolume:
      return seen_center(before, volume_centroid(before, session.context()), session.context());
    default: {
      CoefficientsFile file;
      file.expansion = before;
      const Mesh surface = surface_of(Input(std::move(file)), o.input, {}, {}, session);
      CenterOptions options = wanted;
      options.rays = 0;
      return find_center(surface, options, session.context()).center;
    }
  }
}

// Returns the change by moving to the new centre and back, which is the loss on the way.
std::optional<double> there_and_back(const Expansion& before, const Expansion& after,
                                     Session& session) {
  try {
    const Expansion back = recentered(after, before.center, session.context());
    return distance(before.coefficients, back.coefficients);
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) throw;
    return std::nullopt;
  }
}

int run(const Options& options, Session& session) {
  const CenterOptions wanted = parse_center_option(options.center);
  const CoefficientsOutput output =
      coefficients_output(options.to.output, options.to.format, options.to.json);
  const Convention convention = options.to.convention.output_convention();
  check_writable(options.to.output);
  const Expansion before = read_expansion(options.input, session, options.to.input_convention);
  const Vec3 center = wanted_center(options, wanted, before, session);
  const Expansion after = recentered(before, center, session.context());
  const std::optional<double> lost = there_and_back(before, after, session);
  write_coefficients_output(after, output, convention, session);
  const double moved = norm(after.center - before.center);
  if (options.to.json) {
    print_json({{"file", options.input},
                {"center_before", json_of(before.center)},
                {"center", json_of(after.center)},
                {"moved", moved},
                {"degree", after.coefficients.degree()},
                {"function", to_string(after.function)},
                {"there_and_back", json_of(lost)}});
    return 0;
  }
  std::string text = fmt::format("{}: recentered\n", display_name(options.input));
  text += line("centre", fmt::format("{}, was {}", text_of(after.center), text_of(before.center)));
  text += line("moved", text_of(moved));
  text += line("there and back", lost ? text_of(*lost) + " rms over solid angle" : "not possible");
  text.pop_back();  // the note ends the line
  session.note(text);
  return 0;
}

std::vector<Option> option_list(Options& o) {
  Option center = center_option(o.center);
  center.help =
      "volume: the centroid of the solid, or the nearest point from which the whole surface is "
      "visible; auto, kernel, slope, cosine: as for meshes, for a fine mesh of the surface; "
      "centroid: the centroid of the surface; none: the origin; volume by default";
  std::vector<Option> list = {model_operand(o.input)};
  list.push_back(center);
  append(list, coefficients_output_options(o.to, "file of coefficients to write"));
  return list;
}

}  // namespace

Command recenter_command() {
  auto options = std::make_shared<Options>();
  return {.name = "recenter",
          .summary = "Expand the same surface about another centre",
          .description =
              "Computes the coefficients of the same surface about another centre, up to the same "
              "degree. The surface does not move. Detail that moves to higher degrees is lost, and "
              "the report gives its size.\n\nThe size is the root mean square difference, over all "
              "directions, after a change of the centre there and back. Stored errors of the model "
              "are dropped. A given centre from which the whole surface is not visible is refused. "
              "'rholm align' changes the centre itself.",
          .options = in_groups(option_list(*options), {{Group::kData, {"center"}}}),
          .examples = {"rholm recenter bumpy.h5 -o centred.h5",
                       "rholm recenter bumpy.h5 --center 0.05,0,0 --json -o moved.h5"},
          .run = [options](Session& session) { return run(*options, session); },
          .if_not_star = "Take another --center, or leave out --center",
          .per_shape = PerShape{.extension = "h5"}};
}

}  // namespace rholm::cli
