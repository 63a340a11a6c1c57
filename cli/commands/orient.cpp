// rholm orient: normals for points.
#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "cli/options/field_options.h"
#include "cli/terminal/field_json.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/error.h"
#include "rholm/points.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  OrientOptions orient;
  std::string columns;
  std::string output;
  std::string format;
  bool ascii = false;
  bool json = false;
};

// Returns points; for a mesh its vertices, without information from its faces.
PointCloud points_of(ShapeFile file, const std::string& path, Session& session) {
  say_what_was_read(file, path, session);
  if (auto* cloud = std::get_if<PointCloud>(&file.shape)) return std::move(*cloud);
  Mesh mesh = std::get<Mesh>(std::move(file.shape));
  session.note(fmt::format("{} is a mesh; its {} vertices are used as points", display_name(path),
                           mesh.vertices.size()));
  std::erase_if(mesh.attributes, [](const Attribute& a) {
    return a.name == "nx" || a.name == "ny" || a.name == "nz";
  });
  return {
      .points = std::move(mesh.vertices), .normals = {}, .attributes = std::move(mesh.attributes)};
}

std::string report_text(const OrientReport& report, bool by_sight, bool had_normals) {
  std::string text = line("points", fmt::format("{}", report.points));
  if (report.duplicates > 0) {
    text += line("duplicates", fmt::format("{}, with the normals of the first", report.duplicates));
  }
  text += line("neighbours", fmt::format("{} a fit", report.neighbors));
  if (!by_sight) text += line("components", fmt::format("{}", report.components));
  text += line("computed", counted(report.computed, "normal"));
  if (had_normals) text += line("turned round", counted(report.flipped, "normal"));
  if (report.outliers > 0) {
    text += line("outliers", fmt::format("{} far from all others, with the normals of the nearest",
                                         counted(report.outliers, "point")));
  }
  if (report.undetermined > 0) {
    text += line("without a plane", counted(report.undetermined, "point"));
  }
  text += line("mean confidence", fmt::format("{:.3f}", report.mean_confidence));
  return text + line("unsure", fmt::format("{:.2f} % of the points", 100 * report.unsure));
}

int run(const Options& options, Session& session) {
  const OrientOptions& wanted = options.orient;
  if (wanted.center && wanted.sensor)
    throw UsageError("--center and --sensor exclude each other; give one of them");
  const ShapeFormat format = points_output(options.output, options.format, options.json);
  check_writable(options.output);
  PointCloud cloud =
      points_of(read_shape_input(options.input, session, options.columns), options.input, session);
  const bool had_normals = !cloud.normals.empty();
  const OrientReport report = orient(cloud, wanted, session.context());
  stop_if_interrupted();
  write_shape_output(cloud, options.output, {format, options.ascii}, session);
  if (options.json) {
    Json json;
    json["file"] = options.input;
    json.update(json_of_fields(report));
    print_json(json);
  } else if (options.output != "-") {
    session.report(fmt::format("{}: oriented\n", display_name(options.input)) +
                   report_text(report, wanted.center || wanted.sensor, had_normals));
  }
  if (report.unsure > kTooUnsure) {
    throw Error(ErrorCode::kNotConverged,
                fmt::format("the orientation of {:.3g} % of the normals is uncertain; the file is "
                            "written. Give --center or --sensor",
                            100 * report.unsure));
  }
  return 0;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = {{.name = "POINTS",
                               .help = "file of points, or - for standard input",
                               .target = &o.input,
                               .required = true,
                               .offer = Offer::kShapes}};
  append(list, field_options(o.orient));
  append(list, {columns_option(o.columns),
                output_option(o.output, fmt::format("points to write: {}; - for standard output",
                                                    shape_extensions(Holding::kPoints))),
                format_option(o.format, shape_format_names(Holding::kPoints)),
                ascii_option(o.ascii, Holding::kPoints), json_option(o.json)});
  return list;
}

}  // namespace

Command orient_command() {
  auto options = std::make_shared<Options>();
  return {.name = "orient",
          .summary = "Compute outward normals of points",
          .description =
              "Computes a normal for each point by a fit to its nearest neighbours, and orients "
              "all normals outwards. The report says how many normals are new or reversed, and how "
              "certain the orientation is.\n\nThe number of neighbours follows from the noise of "
              "the points. Points in rows take neighbours from several rows, and points at sharp "
              "edges take neighbours of one side. The orientation spreads from neighbour to "
              "neighbour. Between separate components, the winding number decides. Where it "
              "contradicts, in thin or sparse places, a field shared by all points decides. "
              "--center and --sensor decide if one place sees the whole surface. The attributes "
              "sensor_x, sensor_y, sensor_z give the sensor of each point.\n\nThe certainty is "
              "between 0, for a plane, which has no inside, and 1. Points far from all others "
              "count as uncertain. Colours and other attributes stay unchanged.",
          .options = in_groups(option_list(*options), {{Group::kData, {"center", "sensor"}},
                                                       {Group::kOutput, {"confidence"}}}),
          .examples = {"rholm orient points.ply -o oriented.ply",
                       "rholm orient points.ply --center 0,0,0 --json -o radial.ply"},
          .run = [options](Session& session) { return run(*options, session); },
          .per_shape = PerShape{.extension = "ply"}};
}

}  // namespace rholm::cli
