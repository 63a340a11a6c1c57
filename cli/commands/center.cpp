// rholm center: checks whether a mesh is star-shaped, and finds the centre.
#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/paths.h"
#include "cli/files/prepare.h"
#include "cli/grammar/parse.h"
#include "cli/options/field_options.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/field_json.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/error.h"
#include "rholm/star.h"

#include "rholm/topology.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::string center = "auto";
  ChartOptions chart;  // only the rays
  double weld = 0;
  bool json = false;
};

int run(const Options& options, Session& session) {
  const CenterOptions wanted = chart_options(options.chart, options.center).center;
  const Prepared prepared = prepare(read_mesh(options.input, session), options.weld);
  if (prepared.flipped) session.note(kFlipped);
  const StarReport report = find_center(prepared.mesh, wanted, session.context());
  const std::size_t duplicates = report.star_shaped ? 0 : inspect(prepared.mesh).duplicate_faces;
  if (options.json) {
    Json json;
    json["file"] = options.input;
    json["kind"] = to_string(wanted.kind);
    json.update(json_of_fields(report));
    json["flipped"] = prepared.flipped;
    json["duplicate_faces"] = duplicates;
    json["diagonal"] = prepared.diagonal;
    json["relative"] = {{"min_d", prepared.diagonal > 0 ? report.min_d / prepared.diagonal : 0.0}};
    print_json(json);
  } else {
    print_text(fmt::format("{}: {}star-shaped from the centre '{}'\n", display_name(options.input),
                           report.star_shaped ? "" : "not ", options.center) +
               star_report_text(report, prepared.diagonal));
  }
  if (duplicates > 0) {
    session.warn(
        fmt::format("{} of {} faces are duplicates: they have the same three vertices as other "
                    "faces. Remove them with 'rholm repair'",
                    duplicates, prepared.mesh.faces.size()));
  }
  return report.star_shaped ? kDone : kRefused;
}

}  // namespace

Command center_command() {
  auto options = std::make_shared<Options>();
  return {.name = "center",
          .summary = "Find the centre from which a mesh is star-shaped",
          .description =
              "Finds the centre from which the whole surface is visible, and measures how well it "
              "is visible. The exit code is 0 for a star-shaped mesh and 3 for any other mesh. The "
              "report is printed in both cases.\n\nThe figure 'min d' is the smallest distance "
              "from the "
              "centre to the plane of a face; it is negative if the face is seen from behind. The "
              "figure 'min cos gamma' is the smallest cosine between the normal of a face and the "
              "direction to one of its corners. Rays give the shares of directions that meet the "
              "surface once, "
              "more than once, and never.",
          .options = in_groups({{.name = "SHAPE",
                                 .help = "file of a closed mesh, or - for standard input",
                                 .target = &options->input,
                                 .required = true,
                                 .offer = Offer::kShapes},
                                center_option(options->center),
                                field_option_of(options->chart.center, "rays"),
                                weld_option(options->weld),
                                json_option(options->json)},
                               {{Group::kData, {"center"}}}),
          .examples = {"rholm center bumpy.ply", "rholm center bumpy.ply --center cosine --json"},
          .run = [options](Session& session) { return run(*options, session); },
          .per_shape = PerShape{}};
}

}  // namespace rholm::cli
