// rholm compress: any shape as few large caps.
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "cli/commands/atlas_report.h"
#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/prepare.h"
#include "cli/grammar/parse.h"
#include "cli/options/field_options.h"
#include "cli/options/memory_options.h"
#include "cli/terminal/field_json.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/compress.h"
#include "rholm/error.h"
#include "rholm/outward.h"
#include "rholm/patch_atlas.h"
#include "rholm/topology.h"
#include "rholm/truncation.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::optional<double> tolerance;
  std::string unit = to_string(ToleranceUnit::kAbsolute);
  std::string fit;  // empty: least-squares
  Given<CompressOptions> caps;
  Given<PatchAtlasOptions> patches;
  double weld = 0;
  std::string length_unit;
  std::string columns;  // meaning of columns of points; empty: from the file
  MemoryOptions memory;
  std::string output;
  std::string format;
  bool json = false;
};

bool by_integrals(const Options& o) { return o.fit == "integral"; }

void check_options(const Options& o) {
  if (by_integrals(o)) {
    if (!o.patches.has("degree") || o.tolerance) {
      throw UsageError(
          "--fit integral needs --degree L, the degree of the caps, and excludes --tolerance");
    }
    if (o.caps.has("max_degree") || o.caps.has("max_numbers")) {
      throw UsageError("--max-degree and --max-numbers do not apply to --fit integral");
    }
    return;
  }
  if (!o.tolerance) throw UsageError("give --tolerance E, or --fit integral --degree L");
  if (!o.patches.names.empty()) {
    throw UsageError("--degree and --extension need --fit integral");
  }
}

Mesh prepared_mesh(const Options& o, ShapeFile file, Session& session) {
  Outward shape = outward(mesh_of(std::move(file), o.input, session), o.weld);
  if (shape.flipped) session.note(kFlipped);
  Mesh& mesh = shape.welded.mesh;
  const Inspection state = inspect(mesh);
  if (state.misoriented_edges + state.duplicate_faces > 0) {
    session.warn(
        fmt::format("{}: faces have opposite orientations at {} edges, {} faces are duplicates, "
                    "and caps follow both sides; repair it with 'rholm repair'",
                    display_name(o.input), state.misoriented_edges, state.duplicate_faces));
  }
  return std::move(mesh);
}

Compressed compress_shape(const Options& o, ShapeFile file, Session& session) {
  CompressOptions options = o.caps.values;
  options.tolerance = *o.tolerance;
  const bool relative = parse_name<ToleranceUnit>(o.unit) == ToleranceUnit::kDiagonal;
  if (const auto* cloud = std::get_if<PointCloud>(&file.shape)) {
    if (relative) options.tolerance *= bounds(cloud->points).diagonal();
    Compressed found = compress(*cloud, options, session.context());
    if (found.report.turned_normals) session.note(kTurned);
    return found;
  }
  const Mesh mesh = prepared_mesh(o, std::move(file), session);
  if (relative) options.tolerance *= bounds(mesh.vertices).diagonal();
  Compressed found = compress(mesh, options, session.context());
  if (found.report.hidden > 0) {
    session.note(fmt::format(
        "{:.2g} % of the surface is inside the solid, where parts intersect; it is left out",
        100 * found.report.hidden));
  }
  if (found.report.aimed < options.tolerance && std::isfinite(found.report.gap)) {
    session.note(fmt::format("sheets of the surface are {} apart; caps are fitted within {}",
                             text_of(found.report.gap), text_of(found.report.aimed)));
  }
  if (!found.report.topology_kept) {
    const Inspection shape = inspect(mesh);
    session.warn(
        fmt::format("the surface of the model has {} parts and {} handles, and the shape has {} "
                    "and {}. Some parts are too thin, too small or too close together for these "
                    "caps; take a smaller tolerance",
                    found.report.components, found.report.genus, shape.components, shape.genus));
  }
  return found;
}

// Runs the paper's way, which has no tolerance.
AtlasModel integrate_shape(const Options& o, ShapeFile file, Session& session) {
  const PatchAtlasOptions& options = o.patches.values;
  if (const auto* cloud = std::get_if<PointCloud>(&file.shape)) {
    return patch_atlas(*cloud, options, session.context()).model;
  }
  return patch_atlas(prepared_mesh(o, std::move(file), session), options, session.context()).model;
}

void report(const Options& options, const AtlasModel& model, const CompressReport* found,
            Session& session) {
  const auto bytes = file_size_of(options.output);
  if (!options.json) {
    std::string text = fmt::format("{}: atlas of caps\n", display_name(options.input));
    if (bytes) text += line("bytes", fmt::format("{}", *bytes));
    session.note(text + atlas_text(model));
    return;
  }
  Json json;
  json["file"] = options.input;
  json["output"] = options.output;
  json["bytes"] = bytes ? Json(*bytes) : Json(nullptr);
  if (found != nullptr) json.update(json_of_fields(*found));
  json.update(atlas_json(model));
  print_json(json);
}

void write_model(const Options& options, AtlasModel& model) {
  model.unit = options.length_unit;
  write_atlas(model, options.output);
}

int run(const Options& options, Session& session) {
  options.memory.keep(session);
  check_options(options);
  const CoefficientsOutput output =
      coefficients_output(options.output, options.format, options.json);
  if (output.format) throw UsageError("an atlas is written to a model file; use -o NAME.h5");
  check_writable(options.output);

  ShapeFile file = read_shape_input(options.input, session, options.columns);
  if (std::holds_alternative<PointCloud>(file.shape)) {
    say_what_was_read(file, options.input, session);
  }
  if (by_integrals(options)) {
    AtlasModel model = integrate_shape(options, std::move(file), session);
    write_model(options, model);
    report(options, model, nullptr, session);
    return 0;
  }
  Compressed found = compress_shape(options, std::move(file), session);
  write_model(options, found.model);
  report(options, found.model, &found.report, session);
  if (!found.report.met) {
    throw Error(ErrorCode::kNotConverged,
                fmt::format("the tolerance of {} is not reached: the distance is {} rms. The file "
                            "is written; take a smaller tolerance for more caps",
                            text_of(found.model.tolerance), text_of(found.model.errors->rms())));
  }
  return 0;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = {
      {.name = "SHAPE",
       .help =
           "file of a mesh, or of points with normals that point outwards, or - for standard input",
       .target = &o.input,
       .required = true,
       .offer = Offer::kShapes},
      {.name = "tolerance",
       .value = "E",
       .help = "largest rms distance between the two surfaces, measured both ways; exit code 4 if "
               "it is not reached, 3 without a file if no atlas reaches it",
       .target = &o.tolerance,
       .above = 0},
      {.name = "unit",
       .help = "unit of the tolerance: absolute, the unit of the shape; diagonal, the diagonal of "
               "its bounding box; absolute by default",
       .target = &o.unit,
       .choices = {to_string(ToleranceUnit::kAbsolute), to_string(ToleranceUnit::kDiagonal)}},
      field_option_of(o.caps, "max_degree"),
      field_option_of(o.caps, "max_numbers"),
      field_option_of(o.caps, "seed"),
      weld_option(o.weld),
      length_unit_option(o.length_unit),
      columns_option(o.columns),
      output_option(o.output, "model file to write: .h5"),
      format_option(o.format, {"h5"}),
      {.name = "fit",
       .help =
           "least-squares: caps fitted to the surface; integral: patches by a kd-tree and "
           "integrals over their points up to --degree, for comparison; least-squares by default",
       .target = &o.fit,
       .choices = {"least-squares", "integral"}},
      field_option_of(o.patches, "degree", "with --fit integral, "),
      field_option_of(o.patches, "extension", "with --fit integral, ")};
  append(list, memory_options(o.memory));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command compress_command() {
  auto options = std::make_shared<Options>();
  return {.name = "compress",
          .summary = "Make a small model of any shape: an atlas of caps",
          .description =
              "Makes a model of a mesh or of points with normals, star-shaped or not. The model "
              "has few large caps that keep the tolerance. Each cap is a function on its own "
              "sphere, and the caps are blended.\n\nThe error is the distance between the shape "
              "and the surface that 'rholm synthesize' makes of the model, measured both ways. "
              "Where parts of a closed mesh intersect, the outer surface is taken.",
          .options = in_groups(option_list(*options),
                               {{Group::kAccuracy, {"tolerance", "unit", "max-numbers"}},
                                {Group::kAdvanced, {"length-unit"}},
                                {Group::kPaper, {"fit", "degree", "extension"}}}),
          .examples = {"rholm compress bumpy.ply --tolerance 1e-2 --unit diagonal -o caps.h5",
                       "rholm compress bumpy.ply --fit integral --degree 8 -o patches.h5"},
          .run = [options](Session& session) { return run(*options, session); },
          .per_shape = PerShape{.extension = "h5"}};
}

}  // namespace rholm::cli
