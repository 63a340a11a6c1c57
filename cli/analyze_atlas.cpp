// rholm analyze --atlas: any shape as few large caps.
#include <variant>

#include <fmt/format.h>

#include "cli/atlas_report.h"
#include "cli/inputs.h"
#include "cli/outputs.h"
#include "cli/parse.h"
#include "cli/prepare.h"
#include "rholm/error.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

void check_options(const AnalyzeCommandOptions& o) {
  const auto refuse = [](bool given, const char* name) {
    if (given) throw UsageError(fmt::format("{} does not go with --atlas", name));
  };
  if (!o.tolerance.tolerance) throw UsageError("--atlas needs --tolerance E");
  if (!(*o.tolerance.tolerance > 0)) throw UsageError("--tolerance: it must be above 0");
  refuse(o.degree.has_value(), "--degree");
  refuse(o.method != "edge", "--method");
  refuse(!o.engine.empty(), "--engine");
  refuse(o.center != "auto", "--center");
  refuse(o.allow_signed, "--signed");
  refuse(o.precision.has_value(), "--precision");
  refuse(o.tolerance.norm == "max", "--norm max");
  refuse(o.tolerance.measure == "radius", "--measure radius");
  refuse(o.tolerance.unit == "radius", "--unit radius");
  refuse(o.samples || o.deviation || o.most_samples, "Monte Carlo");
  if (o.tolerance.max_degree && (*o.tolerance.max_degree < 2 || *o.tolerance.max_degree > 24)) {
    throw UsageError("--max-degree of a cap is 2 ... 24");
  }
}

Compressed compress_shape(const AnalyzeCommandOptions& o, ShapeFile file, Session& session) {
  CompressOptions options;
  options.tolerance = *o.tolerance.tolerance;
  options.seed = o.seed;
  if (o.tolerance.max_degree) options.max_degree = *o.tolerance.max_degree;
  const bool relative = o.tolerance.unit == "diagonal";
  if (const auto* cloud = std::get_if<PointCloud>(&file.shape)) {
    if (relative) options.tolerance *= bounds(cloud->points).diagonal();
    return compress(*cloud, options, session.context());
  }
  Mesh mesh = mesh_of(std::move(file), o.input, session);
  mesh = weld(mesh, o.weld).mesh;
  if (inspect(mesh).inside_out) {
    flip(mesh);
    session.note(kFlipped);
  }
  if (relative) options.tolerance *= bounds(mesh.vertices).diagonal();
  return compress(mesh, options, session.context());
}

}  // namespace

int analyze_atlas(const AnalyzeCommandOptions& options, Session& session) {
  check_options(options);
  const CoefficientsOutput output =
      coefficients_output(options.output, options.format, options.json);
  if (output.format) throw UsageError("an atlas goes to a model file: -o NAME.h5");
  check_writable(options.output);

  Compressed found = compress_shape(options, read_shape_input(options.input, session), session);
  found.model.unit = options.length_unit;
  write_atlas(found.model, options.output);
  const auto bytes = file_size_of(options.output);
  if (options.json) {
    Json json;
    json["file"] = options.input;
    json["output"] = options.output;
    json["bytes"] = bytes ? Json(*bytes) : Json(nullptr);
    json["met"] = found.report.met;
    json["samples"] = found.report.samples;
    json["uncovered"] = found.report.uncovered;
    json["genus"] = found.report.genus;
    json.update(atlas_json(found.model));
    for (const auto& [stage, time] : found.report.times) {
      json["times"][stage] = {{"wall", time.wall}, {"cpu", time.cpu}};
    }
    print_json(json);
  } else {
    std::string text = fmt::format("{}: atlas of caps\n", display_name(options.input));
    if (bytes) text += line("bytes", fmt::format("{}", *bytes));
    session.note(text + atlas_text(found.model));
  }
  if (!found.report.met) {
    throw Error(ErrorCode::kNotConverged,
                fmt::format("the tolerance of {} is not kept by what was written: the distance is "
                            "{} rms; take a smaller tolerance for more, finer caps",
                            text_of(found.model.tolerance), text_of(found.model.errors->rms())));
  }
  return 0;
}

}  // namespace rholm::cli
