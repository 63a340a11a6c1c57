// rholm transfer: the detail of a patch laid on a patch of another mesh.
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
#include "cli/options/region_option.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string from, to;
  std::vector<std::string> from_regions, to_regions;
  int from_degree = 8;
  double scale = 1, height = 1;
  std::optional<double> transition;
  std::string rotate = "auto", mode = "displacement";
  bool repeat = false, refine = false, remove_own = false;
  std::string output, format;
  InputConvention convention;
  bool ascii = false, json = false;
};

constexpr double kDegree = std::numbers::pi / 180;
// Edges of the target, in those of the texture on it, from which on it is worth a word.
constexpr double kCoarse = 1.5;

void check_angle(const std::string& option, const std::string& text) {
  if (text == "auto" || read_number(text)) return;
  throw UsageError(
      fmt::format("{} is '{}'; it must be auto or a finite number of degrees", option, text));
}

TransferUpdate update_of(const Options& o) {
  TransferUpdate wanted{.height = o.height, .repeat = o.repeat, .remove_own = o.remove_own};
  if (o.rotate != "auto") wanted.angle = parse_numbers("--rotate", o.rotate, 1)[0] * kDegree;
  if (o.mode == "coefficients") {
    if (o.repeat || o.remove_own) {
      throw UsageError("--mode coefficients knows neither --repeat nor --remove-own");
    }
    wanted.mode = TransferMode::kCoefficients;
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
    print_json({{"from", options.from},
                {"to", options.to},
                {"output", options.output},
                {"mode", options.mode},
                {"from_degree", options.from_degree},
                {"source_radius", report.source_radius},
                {"target_radius", report.target_radius},
                {"scale", report.scale},
                {"source_wavelength", report.source_wavelength},
                {"target_wavelength", report.target_wavelength},
                {"source_edge", report.source_edge},
                {"target_edge", report.target_edge},
                {"source_rms", report.source_rms},
                {"height", options.height},
                {"angle", angle / kDegree},
                {"best_angle", report.angle / kDegree},
                {"correlation", report.correlation},
                {"vertices", moved},
                {"new_vertices", report.new_vertices}});
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
    throw UsageError("standard input is one file: --from and --to cannot both be -");
  }
  check_writable(options.output);
  const Mesh source = read_surface(options.from, session, options.convention);
  const Mesh target =
      options.to == options.from ? source : read_surface(options.to, session, options.convention);
  TransferAnalysis analysis = analyze_transfer(source, from, target, to,
                                               {.from_degree = options.from_degree,
                                                .scale = options.scale,
                                                .refine = options.refine,
                                                .transition = options.transition.value_or(-1)},
                                               session.context());
  const TransferReport& report = analysis.report;
  const std::vector<Vec3> positions = update(analysis, wanted);
  apply(analysis.patch, positions, analysis.mesh);
  stop_if_interrupted();
  write_shape_output(analysis.mesh, options.output, {format, options.ascii}, session);
  const double coarse = report.target_edge / (report.source_edge * report.scale);
  if (!options.refine && coarse > kCoarse) {
    session.note(fmt::format(
        "edges of the target are {:.2g} times as long as those of the texture on it; --refine "
        "splits them",
        coarse));
  }
  print_report(options, report, wanted.angle.value_or(report.angle),
               moved_vertices(analysis.patch, positions), session);
  return 0;
}

std::vector<Option> edit_options(Options& o) {
  return {{.name = "from",
           .value = "SOURCE",
           .help = "mesh or model with the detail, or - for standard input",
           .target = &o.from,
           .required = true,
           .offer = Offer::kShapesAndCoefficients},
          region_option("from-region", "where the detail is: ball, vertex, box, property, color",
                        o.from_regions),
          {.name = "to",
           .value = "TARGET",
           .help = "mesh or model that gets it, or - for standard input",
           .target = &o.to,
           .required = true,
           .offer = Offer::kShapesAndCoefficients},
          region_option("to-region", "where it is laid", o.to_regions),
          {.name = "from-degree",
           .value = "L0",
           .help = "detail is what harmonics up to L0 over the source region leave: waves shorter "
                   "than 4/L0 of its radius; default 8",
           .target = &o.from_degree,
           .min = 2,
           .max = kMaxTransferDegree},
          {.name = "scale",
           .value = "S",
           .help = "size of the source region laid on the target, by that of the target region; "
                   "1 (default) fills it",
           .target = &o.scale,
           .min = 1e-6,
           .max = 1e6},
          {.name = "height",
           .value = "H",
           .help = "further factor of the heights, 1 by default; -1 turns bumps into pits",
           .target = &o.height},
          {.name = "rotate",
           .value = "DEG",
           .help = "turn of the detail, counter-clockwise from outside; auto (default) is where it "
                   "is most like the target's own",
           .target = &o.rotate,
           .check = check_angle},
          {.name = "repeat",
           .help = "lay the detail again and again, for scales below 1",
           .target = &o.repeat},
          {.name = "refine",
           .help = "split edges of the target where the detail is finer",
           .target = &o.refine},
          {.name = "remove-own",
           .help = "take the target's own detail of the same waves away first",
           .target = &o.remove_own},
          {.name = "transition",
           .value = "T",
           .help = "width over which the detail fades outside the region; by default the length "
                   "of the waves of L0 there, at most a quarter of its radius",
           .target = &o.transition,
           .min = 0},
          {.name = "mode",
           .help = "displacement (default): along the normals of the target's base; coefficients: "
                   "put the harmonics above L0 of one cap into the other, raw, for comparison",
           .target = &o.mode,
           .choices = {"displacement", "coefficients"}}};
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
      .summary = "Detail of a patch laid on a patch of another mesh",
      .description =
          std::string(
              "Takes the height of the source region above its smooth base and lays it on the "
              "smooth base of the target region: turned about the middle to where both are most "
              "alike, scaled, faded around the region. Other vertices stay as they are, to the "
              "last bit, and so does the connectivity without --refine. Regions should be about "
              "as wide as long and be visible from one side.\n\n") +
          kRegionHelp,
      .options = option_list(*options),
      .examples = {"rholm transfer --from bumpy.ply --from-region ball:1,0,0,0.5 --to smooth.ply "
                   "--to-region ball:0,0,1,0.3 -o textured.ply",
                   "rholm transfer --from bumpy.ply --from-region vertex:7,0.5 --to smooth.ply "
                   "--to-region ball:0,0,1,0.5 --scale 0.4 --repeat --refine --rotate 30 --json "
                   "-o scales.ply"},
      .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
