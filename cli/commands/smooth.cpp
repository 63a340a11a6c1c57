// rholm smooth: removes detail from a region.
#include "rholm/smooth.h"

#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/surfaces.h"
#include "cli/grammar/parse.h"
#include "cli/options/field_options.h"
#include "cli/options/region_option.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::vector<std::string> regions;
  PatchOptions patch;
  PatchUpdate update;
  std::string output, format;
  InputConvention convention;
  bool ascii = false, json = false;
};

// Displacement of the vertices.
struct Moved {
  double rms = 0, max = 0;
};

Moved moved_by(const Patch& patch, const std::vector<Vec3>& positions) {
  Moved moved;
  double sum = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double d = norm(positions[i] - patch.positions[i]);
    sum += d * d;
    moved.max = std::max(moved.max, d);
  }
  if (!positions.empty()) moved.rms = std::sqrt(sum / static_cast<double>(positions.size()));
  return moved;
}

void print_report(const Options& options, const Patch& patch, const Moved& moved, double diagonal,
                  Session& session) {
  if (options.json) {
    print_json({{"file", options.input},
                {"output", options.output},
                {"wavelength", patch.wavelength},
                {"strength", options.update.strength},
                {"fitting", to_string(options.patch.fitting)},
                {"repair", options.patch.repair},
                {"vertices", patch.vertices.size()},
                {"caps", patch.caps},
                {"unreached", patch.unreached},
                {"rms_move", moved.rms},
                {"max_move", moved.max},
                {"diagonal", diagonal}});
  } else if (options.output != "-") {
    session.report(
        fmt::format("{}: smoothed\n", display_name(options.input)) +
        line("vertices",
             fmt::format("{}, of {}", patch.vertices.size(), counted(patch.caps, "cap"))) +
        line("moved by",
             fmt::format("{:.3g} rms, {:.3g} at most ({:.2g} of the diagonal)", moved.rms,
                         moved.max, diagonal > 0 ? moved.max / diagonal : 0.0)));
  }
}

int run(const Options& options, Session& session) {
  if (options.patch.repair && options.patch.fitting == PatchFitting::kMean) {
    throw UsageError("--repair and --fitting mean exclude each other; use --fitting robust");
  }
  const std::vector<Region> regions = parse_regions(options.regions);
  const ShapeFormat format = mesh_output(options.output, options.format, options.json);
  check_writable(options.output);
  Mesh mesh = read_surface(options.input, session, options.convention);
  const double diagonal = bounds(mesh.vertices).diagonal();
  const Patch patch = analyze_patch(mesh, regions, options.patch, session.context());
  const std::vector<Vec3> positions = update(patch, options.update);
  apply(patch, positions, mesh);
  stop_if_interrupted();
  write_shape_output(mesh, options.output, {format, options.ascii}, session);
  if (patch.unreached > 0) {
    session.warn(fmt::format("{} of the region stay unchanged, because no cap reaches them",
                             counted(patch.unreached, "vertex", "vertices")));
  }
  if (options.patch.repair && patch.vertices.empty())
    session.note("no scratch or spike was found, and nothing was moved");
  print_report(options, patch, moved_by(patch, positions), diagonal, session);
  return 0;
}

std::vector<Option> edit_options(Options& o) {
  Option wavelength = field_option_of(o.patch, "wavelength");
  wavelength.required = true;
  return {{.name = "SHAPE",
           .help = "file of a mesh, or of a model whose surface is taken, or - for standard input",
           .target = &o.input,
           .required = true,
           .offer = Offer::kShapesAndCoefficients},
          region_option(
              "region",
              "region to smooth: ball, vertex, box, property or color; --help all describes them",
              o.regions),
          wavelength,
          field_option_of(o.update, "strength"),
          field_option_of(o.patch, "fitting"),
          field_option_of(o.patch, "repair"),
          field_option_of(o.patch, "transition")};
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = edit_options(o);
  append(list, mesh_output_options(o.output, o.format, o.ascii));
  append(list, input_convention_options(o.convention));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command smooth_command() {
  auto options = std::make_shared<Options>();
  return {.name = "smooth",
          .summary = "Smooth a region of a mesh",
          .description =
              std::string(
                  "Removes detail shorter than a wavelength from a region of a mesh. The edit "
                  "fades in a transition around the region. All other vertices, the faces and the "
                  "colours stay bit for bit the same.\n\nThe region is covered with overlapping "
                  "caps. Harmonics are fitted to each cap, up to the degree of the wavelength. For "
                  "scratches, cracks and spikes use --repair with two to three times their width "
                  "as wavelength. Where they are marked by colour, --fitting around bridges them. "
                  "For scan noise and pores use a wavelength above theirs.\n\n") +
              kRegionHelp,
          .options = in_groups(option_list(*options), {{Group::kData, {"region", "wavelength"}},
                                                       {Group::kAccuracy, {"strength", "repair"}}}),
          .examples = {"rholm smooth bumpy.ply --region ball:0,0,1,0.4 --wavelength 0.3 "
                       "-o smooth.ply",
                       "rholm smooth bumpy.ply --region vertex:7,0.3 --wavelength 0.25 --repair "
                       "--json -o repaired.ply"},
          .run = [options](Session& session) { return run(*options, session); },
          .per_shape = PerShape{.extension = "ply"}};
}

}  // namespace rholm::cli
