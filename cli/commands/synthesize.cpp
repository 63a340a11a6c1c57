// rholm synthesize: meshes from coefficients.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "cli/commands/atlas_report.h"
#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/surfaces.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "cli/options/simplify_option.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/compress.h"
#include "rholm/primitives.h"
#include "rholm/synthesize.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::string degrees;
  std::optional<int> subdivisions;
  std::string grid;
  std::string like;
  std::optional<double> resolution;  // only for an atlas
  std::optional<int> degree_limit;
  std::string simplify;  // empty: as in the model
  std::string output;
  std::string format;
  InputConvention convention;
  bool ascii = false;
  bool json = false;
};

// Returns the output file. A single degree writes to the output itself, several degrees to names
// with the degree: out.ply becomes out-L16.ply.
std::string output_for(const std::string& output, int degree, bool several) {
  if (!several) return output;
  std::filesystem::path path(output);
  const std::string name =
      fmt::format("{}-L{}{}", path.stem().string(), degree, path.extension().string());
  return path.replace_filename(name).string();
}

void check_options(const Options& options, bool several) {
  const int samplings =
      options.subdivisions.has_value() + !options.grid.empty() + !options.like.empty();
  if (samplings > 1) {
    throw UsageError("--subdivisions, --grid and --like exclude one another; give one of them");
  }
  if (several && options.output == "-") {
    throw UsageError("several degrees make several files; -o must be a file name, not -");
  }
}

int write_surface(const AtlasModel& model, const AtlasSynthesisOptions& wanted, const Options& o,
                  ShapeFormat format, Session& session) {
  const Mesh surface = synthesize(model, wanted, session.context());
  stop_if_interrupted();
  if (model.rules && !model.rules->left_out.empty()) {
    session.warn(fmt::format("{}: the model does not store {} of the surface",
                             display_name(o.input), left_out_text(*model.rules)));
  }
  write_shape_output(surface, o.output, {format, o.ascii}, session);
  if (model.rules && model.rules->tiles) {
    session.note(
        fmt::format("{}: the model was made in tiles. The vertices have another order, and the "
                    "surface over holes may differ by some steps of the grid",
                    display_name(o.input)));
  }
  if (o.json) {
    Json json;
    json["file"] = o.input;
    json["output"] = o.output;
    json["counts"] = {{"vertices", surface.vertices.size()}, {"faces", surface.faces.size()}};
    json["resolution"] = wanted.step > 0 ? wanted.step : model.step;
    print_json(json);
  } else {
    session.note(fmt::format("{} and {}", counted(surface.vertices.size(), "vertex", "vertices"),
                             counted(surface.faces.size(), "face")));
  }
  return 0;
}

int run_atlas(const Options& o, ShapeFormat format, Session& session) {
  if (!o.degrees.empty() || o.subdivisions || !o.grid.empty() || !o.like.empty()) {
    throw UsageError(
        "--degree, --subdivisions, --grid and --like do not apply to an atlas of caps; use "
        "--resolution and --degree-limit");
  }
  std::optional<SimplifyOptions> simplify;
  if (!o.simplify.empty()) {
    // All triangles may stay, whatever the model's rules say.
    simplify = parse_simplify("--simplify", o.simplify).value_or(SimplifyOptions{.share = 1});
  }
  check_writable(o.output);
  const AtlasModel model = read_atlas(o.input);
  AtlasSynthesisOptions wanted;
  if (o.resolution) wanted.step = *o.resolution;
  wanted.degree = o.degree_limit;
  wanted.simplify = simplify;
  return write_surface(model, wanted, o, format, session);
}

std::array<int, 2> parse_rings(const std::string& option, const std::string& text) {
  return parse_grid(option, text, {1, 3});
}

// Returns the sphere with the directions of the surface's vertices.
Mesh sphere_of(const Options& options, int degree, const Expansion& expansion, Session& session) {
  if (!options.grid.empty()) {
    const auto [n_theta, n_phi] = parse_rings("--grid", options.grid);
    return latitude_longitude_sphere(n_theta, n_phi);
  }
  if (!options.like.empty()) {
    return directions_of(read_mesh(options.like, session), expansion.center);
  }
  return icosphere(options.subdivisions.value_or(subdivisions_for(degree, kForFiles)));
}

int run(const Options& options, Session& session) {
  const ShapeFormat format = mesh_output(options.output, options.format, options.json);
  if (holds_atlas(options.input)) return run_atlas(options, format, session);
  if (options.resolution || options.degree_limit || !options.simplify.empty()) {
    throw UsageError("--resolution, --degree-limit and --simplify apply only to an atlas of caps");
  }
  std::vector<int> degrees;
  if (!options.degrees.empty()) degrees = parse_degrees("--degree", options.degrees);
  const bool several = degrees.size() > 1;
  check_options(options, several);
  check_writable(options.output);
  for (const int degree : degrees) check_writable(output_for(options.output, degree, several));

  const Expansion expansion = read_expansion(options.input, session, options.convention);
  const int highest = expansion.coefficients.degree();
  if (degrees.empty()) degrees.push_back(highest);
  for (const int degree : degrees) {
    if (degree <= highest) continue;
    session.warn(fmt::format("{} has coefficients only up to degree {}; degree {} is reduced to it",
                             display_name(options.input), highest, degree));
  }
  const int needed = std::min(highest, *std::max_element(degrees.begin(), degrees.end()));
  const Mesh sphere = sphere_of(options, needed, expansion, session);
  const std::vector<Mesh> surfaces = synthesize(expansion, sphere, degrees, session.context());

  Json json;
  json["file"] = options.input;
  json["counts"] = {{"vertices", sphere.vertices.size()}, {"faces", sphere.faces.size()}};
  json["outputs"] = Json::array();
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    const std::string path = output_for(options.output, degrees[i], several);
    warn_of_crossings(surfaces[i], sphere, expansion.center, path, session);
    stop_if_interrupted();
    write_shape_output(surfaces[i], path, {format, options.ascii}, session);
    json["outputs"].push_back({{"degree", std::min(degrees[i], highest)}, {"file", path}});
    if (several) session.note(fmt::format("degree {} is in {}", degrees[i], path));
  }
  if (options.json) print_json(json);
  return 0;
}

std::vector<Option> synthesis_options(Options& o) {
  return {{.name = "MODEL",
           .help = "file of coefficients or of an atlas",
           .target = &o.input,
           .required = true,
           .offer = Offer::kCoefficients},
          {.name = "degree",
           .value = "L[,L...]",
           .help = "degree at which the series is cut off; by default the degree of the file. "
                   "Several degrees give several files: OUT-L4.ply, OUT-L16.ply",
           .target = &o.degrees,
           .check = parse_degrees},
          {.name = "subdivisions",
           .value = "N",
           .help = "subdivisions of an icosahedron: the mesh has 10 4^N + 2 vertices; by default "
                   "the smallest N from 4 to 7 with 2 (L+1)^2 vertices",
           .target = &o.subdivisions,
           .min = 0,
           .max = 12},
          {.name = "grid",
           .value = "NTHETAxNPHI",
           .help = "use circles of latitude and the two poles instead",
           .target = &o.grid,
           .check = parse_rings},
          {.name = "like",
           .value = "SHAPE",
           .help = "use the directions of the vertices of this mesh, and its faces",
           .target = &o.like,
           .offer = Offer::kShapes},
          {.name = "resolution",
           .value = "STEP",
           .help = "for an atlas: edge of the cubes of the grid, in the unit of the shape; by "
                   "default the edge at which the error was measured",
           .target = &o.resolution,
           .above = 0},
          {.name = "degree-limit",
           .value = "L",
           .help = "for an atlas: limit the degree of the caps, for less detail. A limit at which "
                   "caps contradict each other is refused with the least possible limit",
           .target = &o.degree_limit,
           .min = 0,
           .max = 24},
          simplify_option(
              o.simplify,
              "none keeps all faces; by default as the model says, and none without a rule")};
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = synthesis_options(o);
  append(list, mesh_output_options(o.output, o.format, o.ascii));
  append(list, input_convention_options(o.convention));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command synthesize_command() {
  auto options = std::make_shared<Options>();
  return {.name = "synthesize",
          .summary = "Make a mesh from coefficients",
          .description =
              "Computes the surface of coefficients or of an atlas of caps. Several degrees give "
              "several files, which are levels of detail. The mesh has the exact normals of the "
              "smooth surface.",
          .options = in_groups(option_list(*options),
                               {{Group::kAccuracy, {"degree", "subdivisions", "resolution"}},
                                {Group::kAdvanced, {"simplify", "grid", "like", "degree-limit"}}}),
          .examples = {"rholm synthesize bumpy.h5 -o smooth.ply",
                       "rholm synthesize bumpy.h5 --degree 4,8,16 --grid 90x180 -o level.obj"},
          .run = [options](Session& session) { return run(*options, session); },
          .per_shape = PerShape{.extension = "ply"}};
}

}  // namespace rholm::cli
