// rholm transfer: copies the detail of a patch to a patch of another mesh.
#include "rholm/transfer.h"

#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/surfaces.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "cli/options/field_options.h"
#include "cli/options/region_option.h"
#include "cli/terminal/field_json.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string from, to;
  std::vector<std::string> from_regions, to_regions;
  TransferOptions transfer;
  TransferUpdate update;
  std::string rotate = "auto";
  std::string output, format;
  InputConvention convention;
  bool ascii = false, json = false;
};

constexpr double kDegree = std::numbers::pi / 180;
// Ratio of the target's edges to the texture's edges on it, from which a note is given.
constexpr double kCoarse = 1.5;

void check_angle(const std::string& option, const std::string& text) {
  if (text == "auto" || read_number(text)) return;
  throw UsageError(
      fmt::format("{} is '{}'; it must be auto or a finite number of degrees", option, text));
}

TransferUpdate update_of(const Options& o) {
  TransferUpdate wanted = o.update;
  if (o.rotate != "auto") wanted.angle = parse_numbers("--rotate", o.rotate, 1)[0] * kDegree;
  if (wanted.mode == TransferMode::kCoefficients && (wanted.repeat || wanted.remove_own)) {
    throw UsageError("--mode coefficients excludes --repeat and --remove-own");
  }
  return wanted;
}

std::size_t moved_vertices(const Patch& patch, const std::vector<Vec3>& positions) {
  std::size_t moved = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) moved += positions[i] != patch.positions[i];
  return moved;
}

void print_report(const Options& options, const TransferReport& report, double angle,
                  std::size_t moved, Session& session) {
  if (options.json) {
    Json json = {{"from", options.from},
                 {"to", options.to},
                 {"output", options.output},
                 {"mode", to_string(options.update.mode)},
                 {"from_degree", options.transfer.from_degree}};
    json.update(json_of_fields(report));
    json["angle"] = angle / kDegree;
    json["best_angle"] = report.angle / kDegree;
    json["height"] = options.update.height;
    json["vertices"] = moved;
    print_json(json);
    return;
  }
  if (options.output == "-") return;
  session.report(
      fmt::format("{}: detail of {}\n", display_name(options.to), display_name(options.from)) +
      line("texture", fmt::format("{:.3g} rms high, waves shorter than {:.3g}", report.source_rms,
                                  report.source_wavelength)) +
      line("scale", fmt::format("{:.4g}", report.scale)) +
      line("turned by", fmt::format("{:.4g} degrees, best {:.4g} (correlation {:.2f})",
                                    angle / kDegree, report.angle / kDegree, report.correlation)) +
      line("vertices", fmt::format("{} moved, {} new", moved, report.new_vertices)));
}

int run(const Options& options, Session& session) {
  const std::vector<Region> from = parse_regions(options.from_regions);
  const std::vector<Region> to = parse_regions(options.to_regions);
  const TransferUpdate wanted = update_of(options);
  const ShapeFormat format = mesh_output(options.output, options.format, options.json);
  if (options.from == "-" && options.to == "-") {
    throw UsageError("standard input can be only one of --from and --to");
  }
  check_writable(options.output);
  const Mesh source = read_surface(options.from, session, options.convention);
  const Mesh target =
      options.to == options.from ? source : read_surface(options.to, session, options.convention);
  TransferAnalysis analysis =
      analyze_transfer(source, from, target, to, options.transfer, session.context());
  const TransferReport& report = analysis.report;
  const std::vector<Vec3> positions = update(analysis, wanted);
  apply(analysis.patch, positions, analysis.mesh);
  stop_if_interrupted();
  write_shape_output(analysis.mesh, options.output, {format, options.ascii}, session);
  const double coarse = report.target_edge / (report.source_edge * report.scale);
  if (!options.transfer.refine && coarse > kCoarse) {
    session.note(
        fmt::format("edges of the target are {:.2g} times as long as the edges of the detail on "
                    "it; --refine splits them",
                    coarse));
  }
  print_report(options, report, wanted.angle.value_or(report.angle),
               moved_vertices(analysis.patch, positions), session);
  return 0;
}

std::vector<Option> edit_options(Options& o) {
  std::vector<Option> list = {
      {.name = "from",
       .value = "SOURCE",
       .help = "mesh or model with the detail, or - for standard input",
       .target = &o.from,
       .required = true,
       .offer = Offer::kShapesAndCoefficients},
      region_option(
          "from-region",
          "region of the detail: ball, vertex, box, property or color; --help all describes them",
          o.from_regions),
      {.name = "to",
       .value = "TARGET",
       .help = "mesh or model that receives the detail, or - for standard input",
       .target = &o.to,
       .required = true,
       .offer = Offer::kShapesAndCoefficients},
      region_option("to-region", "region that receives the detail", o.to_regions),
      {.name = "rotate",
       .value = "DEG",
       .help = "angle of the detail in degrees, counter-clockwise from outside; auto: best match "
               "with the detail of the target; auto by default",
       .target = &o.rotate,
       .check = check_angle}};
  append(list, field_options(o.transfer));
  append(list, field_options(o.update));
  return list;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = edit_options(o);
  append(list, mesh_output_options(o.output, o.format, o.ascii));
  append(list, input_convention_options(o.convention));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command transfer_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "transfer",
      .summary = "Copy the detail of a region to another mesh",
      .description =
          std::string("Takes the height of a source region above its smooth base, and adds it to "
                      "the smooth base of a target region. The detail is scaled, rotated to the "
                      "best match, and fades around the region. All other vertices stay bit for "
                      "bit the same.\n\nWithout --refine the faces stay the same. Regions should "
                      "be about as long as wide, and visible from one side.\n\n") +
          kRegionHelp,
      .options =
          in_groups(option_list(*options), {{Group::kAccuracy, {"scale", "height", "refine"}}}),
      .examples = {"rholm transfer --from bumpy.ply --from-region ball:1,0,0,0.5 --to smooth.ply "
                   "--to-region ball:0,0,1,0.3 -o textured.ply",
                   "rholm transfer --from bumpy.ply --from-region vertex:7,0.5 --to smooth.ply "
                   "--to-region ball:0,0,1,0.5 --scale 0.4 --repeat --refine --rotate 30 --json "
                   "-o scales.ply"},
      .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
