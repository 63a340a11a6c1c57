// rholm partition: the caps of a shape in colours.
#include <memory>
#include <variant>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/inputs.h"
#include "cli/outputs.h"
#include "cli/parse.h"
#include "cli/prepare.h"
#include "cli/report.h"
#include "cli/session.h"
#include "rholm/compress.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input, output, format;
  double tolerance = 1e-3;
  bool json = false;
};

int run(const Options& options, Session& session) {
  const ShapeFormat format = shape_output(options.output, options.format, options.json);
  if (format != ShapeFormat::kPly) throw UsageError("colours need a .ply file");
  if (!(options.tolerance > 0)) throw UsageError("--tolerance: it must be above 0");
  check_writable(options.output);
  ShapeFile file = read_shape_input(options.input, session);
  Json json;
  json["file"] = options.input;
  json["output"] = options.output;
  const auto finish = [&](auto& shape, const std::vector<Vec3>& points) {
    const double diagonal = bounds(points).diagonal();
    const Compressed found =
        compress(shape, {.tolerance = options.tolerance * diagonal}, session.context());
    const auto caps = loudest_caps(found.model.atlas, points, session.context());
    set_cap_colors(shape.attributes, found.model.atlas, caps);
    write_shape(shape, options.output, {format, false}, session.context());
    json["caps"] = found.model.atlas.caps.size();
    if (!options.json) session.note(counted(found.model.atlas.caps.size(), "cap"));
  };
  if (auto* cloud = std::get_if<PointCloud>(&file.shape)) {
    finish(*cloud, cloud->points);
  } else {
    Mesh mesh = weld(mesh_of(std::move(file), options.input, session)).mesh;
    if (inspect(mesh).inside_out) {
      flip(mesh);
      session.note(kFlipped);
    }
    finish(mesh, mesh.vertices);
  }
  if (options.json) print_json(json);
  return 0;
}

}  // namespace

Command partition_command() {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  return {.name = "partition",
          .summary = "The caps of a shape in colours",
          .description =
              "Covers a shape with few large caps, as 'rholm analyze --atlas' does, and writes it "
              "with each vertex in the colour of the cap that speaks loudest there. Caps that "
              "touch have different hues.",
          .options = {{.name = "SHAPE",
                       .help = "file of a mesh, or of points with normals, or - for standard input",
                       .target = &o.input,
                       .required = true,
                       .offer = Offer::kShapes},
                      {.name = "tolerance",
                       .value = "E",
                       .help = "rms distance of the caps, of the diagonal; 0.001 by default",
                       .target = &o.tolerance,
                       .min = 0},
                      output_option(o.output, "shape to write: .ply; - for standard output"),
                      format_option(o.format, {"ply"}),
                      json_option(o.json)},
          .examples = {"rholm partition bumpy.ply --tolerance 1e-2 -o caps.ply"},
          .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
