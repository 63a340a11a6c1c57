// rholm analyze --atlas: any shape as a small number of large caps.
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "cli/commands/atlas_report.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/prepare.h"
#include "cli/grammar/parse.h"
#include "cli/terminal/field_json.h"
#include "rholm/error.h"
#include "rholm/outward.h"
#include "rholm/patch_atlas.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

bool by_integrals(const AnalyzeCommandOptions& o) { return o.fit == "integral"; }

void check_options(const AnalyzeCommandOptions& o) {
  const auto refuse = [](bool given, const char* name) {
    if (given) throw UsageError(fmt::format("{} does not go with --atlas", name));
  };
  if (by_integrals(o)) {
    const std::optional<int> degree = degree_of(o);
    if (!degree || o.tolerance.tolerance) {
      throw UsageError(
          "--fit integral needs the degree of the caps, --degree L, and no --tolerance");
    }
    if (*degree > kMaxCapDegree) {
      throw UsageError(fmt::format("--degree of a cap is 0 ... {}", kMaxCapDegree));
    }
    refuse(o.tolerance.rest.has("max_degree"), "--max-degree and --fit integral");
    refuse(o.caps.has("max_numbers"), "--max-numbers and --fit integral");
  } else {
    if (!o.tolerance.tolerance) throw UsageError("--atlas needs --tolerance E");
    refuse(o.analyze.has("degree"), "--degree");
    if (o.patches.has("extension")) throw UsageError("--extension goes with --fit integral");
  }
  refuse(o.method != "edge", "--method");
  refuse(o.analyze.has("engine"), "--engine");
  refuse(o.center != "auto", "--center");
  refuse(o.chart.allow_signed, "--signed");
  refuse(o.analyze.has("precision"), "--precision");
  const Given<Tolerance>& tolerance = o.tolerance.rest;
  refuse(tolerance.values.norm == ErrorNorm::kMax, "--norm max");
  refuse(tolerance.has("measure") && tolerance.values.measure == ErrorMeasure::kRadius,
         "--measure radius");
  refuse(tolerance.values.unit == ToleranceUnit::kRadius, "--unit radius");
  refuse(is_given_to_monte_carlo(o), "Monte Carlo");
  const int max_degree = tolerance.values.max_degree;
  if (tolerance.has("max_degree") && (max_degree < 2 || max_degree > kMaxCapDegree)) {
    throw UsageError(fmt::format("--max-degree of a cap is 2 ... {}", kMaxCapDegree));
  }
}

Mesh prepared_mesh(const AnalyzeCommandOptions& o, ShapeFile file, Session& session) {
  Outward shape = outward(mesh_of(std::move(file), o.input, session), o.weld);
  if (shape.flipped) session.note(kFlipped);
  Mesh& mesh = shape.welded.mesh;
  const Inspection state = inspect(mesh);
  if (state.misoriented_edges + state.duplicate_triangles > 0) {
    session.warn(
        fmt::format("{}: faces disagree about their sides at {} edges, {} faces are "
                    "duplicates, and caps follow both sides: 'rholm repair' mends it",
                    display_name(o.input), state.misoriented_edges, state.duplicate_triangles));
  }
  return std::move(mesh);
}

Compressed compress_shape(const AnalyzeCommandOptions& o, ShapeFile file, Session& session) {
  CompressOptions options = o.caps.values;
  options.tolerance = *o.tolerance.tolerance;
  options.seed = o.monte_carlo.values.seed;
  const Given<Tolerance>& tolerance = o.tolerance.rest;
  if (tolerance.has("max_degree")) options.max_degree = tolerance.values.max_degree;
  const bool relative = tolerance.values.unit == ToleranceUnit::kDiagonal;
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
    session.note(
        fmt::format("{:.2g} % of the surface lies inside of the solid, where parts run "
                    "into each other; it is left out",
                    100 * found.report.hidden));
  }
  if (found.report.aimed < options.tolerance && std::isfinite(found.report.gap)) {
    session.note(fmt::format("sheets of the surface lie {} apart: caps are fitted within {}",
                             text_of(found.report.gap), text_of(found.report.aimed)));
  }
  if (!found.report.topology_kept) {
    const Inspection shape = inspect(mesh);
    session.warn(fmt::format(
        "the surface of the model has {} parts and {} handles (the shape {} and {}): some of it is "
        "too thin or too small for these caps, or lies too close together",
        found.report.components, found.report.genus, shape.components, shape.genus));
  }
  return found;
}

// Uses the paper's method, whose result does not meet a given tolerance.
AtlasModel integrate_shape(const AnalyzeCommandOptions& o, ShapeFile file, Session& session) {
  PatchAtlasOptions options = o.patches.values;
  options.degree = o.analyze.values.degree;
  if (const auto* cloud = std::get_if<PointCloud>(&file.shape)) {
    return patch_atlas(*cloud, options, session.context()).model;
  }
  return patch_atlas(prepared_mesh(o, std::move(file), session), options, session.context()).model;
}

void report(const AnalyzeCommandOptions& options, const AtlasModel& model,
            const CompressReport* found, Session& session) {
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

void write_model(const AnalyzeCommandOptions& options, AtlasModel& model) {
  model.unit = options.length_unit;
  write_atlas(model, options.output);
}

}  // namespace

int analyze_atlas(const AnalyzeCommandOptions& options, Session& session) {
  check_options(options);
  const CoefficientsOutput output =
      coefficients_output(options.output, options.format, options.json);
  if (output.format) throw UsageError("an atlas goes to a model file: -o NAME.h5");
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
                fmt::format("the tolerance of {} is not kept by what was written: the distance is "
                            "{} rms; take a smaller tolerance for more, finer caps",
                            text_of(found.model.tolerance), text_of(found.model.errors->rms())));
  }
  return 0;
}

}  // namespace rholm::cli
