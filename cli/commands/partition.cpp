// rholm partition: the caps of a shape in colours.
#include <algorithm>
#include <memory>
#include <variant>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/prepare.h"
#include "cli/grammar/parse.h"
#include "cli/options/field_options.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/compress.h"
#include "rholm/outward.h"
#include "rholm/patch_atlas.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input, output, format, columns;
  std::string show = "caps";
  double tolerance = 1e-3;
  PatchAtlasOptions patches;
  bool json = false;
};

// Largest number of values. Chosen: a picture may take more values than a small shape has; caps of
// a rough shape need a limit.
constexpr std::size_t kMostShownNumbers = 12000;

// Shows caps made by compress, on the shape itself.
template <typename Shape>
void show_caps(const Options& options, ShapeFormat format, Shape& shape,
               const std::vector<Vec3>& points, Session& session, Json& json) {
  const double diagonal = bounds(points).diagonal();
  const Compressed found = compress(shape,
                                    {.tolerance = options.tolerance * diagonal,
                                     .max_numbers = std::max(kMostShownNumbers, 3 * points.size())},
                                    session.context());
  if (found.report.turned_normals) session.note(kTurned);
  const Atlas& atlas = found.model.atlas;
  const auto caps = dominant_caps(atlas, points, session.context());
  if (options.show == "degrees") {
    set_degree_colors(shape.attributes, atlas, caps);
  } else {
    set_cap_colors(shape.attributes, atlas, caps);
  }
  write_shape_output(shape, options.output, {format, false}, session);
  const auto [least, most] =
      std::minmax_element(atlas.caps.begin(), atlas.caps.end(),
                          [](const Cap& a, const Cap& b) { return a.degree < b.degree; });
  json["caps"] = atlas.caps.size();
  json["degrees"] = {least->degree, most->degree};
  if (!options.json) {
    session.note(fmt::format("{} of degrees {} to {}", counted(atlas.caps.size(), "cap"),
                             least->degree, most->degree));
  }
}

// Shows the patches of the paper.
template <typename Shape>
void show_patches(const Options& options, ShapeFormat format, const Shape& shape, Session& session,
                  Json& json) {
  const PatchPicture picture =
      patch_picture(shape, parse_name<PatchView>(options.show), options.patches, session.context());
  write_shape_output(picture.mesh, options.output, {format, false}, session);
  json["patches"] = picture.patches;
  if (!options.json) {
    session.note(counted(picture.patches, "patch", "patches"));
  }
}

int run(const Options& options, Session& session) {
  const ShapeFormat format = shape_output(options.output, options.format, options.json);
  if (format != ShapeFormat::kPly) throw UsageError("colours need a .ply file");
  check_writable(options.output);
  ShapeFile file = read_shape_input(options.input, session, options.columns);
  Json json;
  json["file"] = options.input;
  json["output"] = options.output;
  json["show"] = options.show;
  const auto finish = [&](auto& shape, const std::vector<Vec3>& points) {
    if (options.show == "caps" || options.show == "degrees") {
      show_caps(options, format, shape, points, session, json);
    } else {
      show_patches(options, format, shape, session, json);
    }
  };
  if (auto* cloud = std::get_if<PointCloud>(&file.shape)) {
    say_what_was_read(file, options.input, session);
    finish(*cloud, cloud->points);
  } else {
    Outward shape = outward(mesh_of(std::move(file), options.input, session));
    if (shape.flipped) session.note(kFlipped);
    finish(shape.welded.mesh, shape.welded.mesh.vertices);
  }
  if (options.json) print_json(json);
  return 0;
}

}  // namespace

Command partition_command() {
  auto options = std::make_shared<Options>();
  Options& o = *options;
  return {
      .name = "partition",
      .summary = "Colour a shape by the caps of its model",
      .description =
          "Covers a shape with few large caps, as 'rholm compress' does, and writes it with a "
          "colour for each cap. A vertex has the colour of the cap with the largest "
          "weight.\n\nNeighbouring caps have different hues. With --show degrees the colour is the "
          "degree of the cap, from dark blue for the lowest to yellow for the highest.\n\nThe "
          "other views show the patches of 'compress --fit integral'. A kd-tree splits the shape "
          "until the normals of each patch stay within a cone. Patches: the points of each patch, "
          "joined by their Delaunay triangles on its best-fitting sphere. Triangles: these "
          "triangles apart. Spheres: the triangles on the spheres.",
      .options = in_groups(
          {{.name = "SHAPE",
            .help = "file of a mesh, or of points with normals, or - for standard input",
            .target = &o.input,
            .required = true,
            .offer = Offer::kShapes},
           {.name = "show",
            .help = "what to draw; caps by default",
            .target = &o.show,
            .choices = {"caps", "degrees", "patches", "triangles", "spheres"}},
           columns_option(o.columns),
           {.name = "tolerance",
            .value = "E",
            .help = "rms distance of the caps, as a fraction of the diagonal; 0.001 by default",
            .target = &o.tolerance,
            .above = 0},
           field_option_of(o.patches, "min_cosine"),
           output_option(o.output, "shape to write: .ply; - for standard output"),
           format_option(o.format, {"ply"}),
           json_option(o.json)},
          {{Group::kAccuracy, {"tolerance"}}, {Group::kPaper, {"min-cosine"}}}),
      .examples = {"rholm partition bumpy.ply --tolerance 1e-2 -o caps.ply",
                   "rholm partition bumpy.ply --show spheres -o spheres.ply"},
      .run = [options](Session& session) { return run(*options, session); },
      .per_shape = PerShape{.extension = "ply"}};
}

}  // namespace rholm::cli
