// rholm render: pictures of shapes and models.
#include "rholm/render.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <limits>
#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/length_units.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/surfaces.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "cli/options/field_options.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/session.h"
#include "rholm/compare.h"
#include "rholm/file.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

struct Options {
  std::vector<std::string> inputs;
  std::string degrees;
  std::string size;
  std::string color;
  std::string against;
  std::optional<double> scale_max;
  RenderOptions render;
  bool flat = false;
  std::string fit = "scale";
  std::string view;
  std::string up;
  std::string labels;
  std::optional<int> subdivisions;
  std::string output;
  std::string format;
  std::string columns;
  InputConvention convention;
};

// Panels point to their shapes: a deque does not move its elements.
struct Scene {
  std::deque<Mesh> meshes;
  std::deque<PointCloud> clouds;
  std::vector<Panel> panels;
  CommonUnit unit;
};

// Sizes in pixels: a single panel fills a picture of its own, several panels share the width.
constexpr int kMinSize = 16, kMaxSize = 16384;
constexpr int kSingleWidth = 1024, kSingleHeight = 768, kPanelWidth = 400, kPanelHeight = 460;

// A picture with more pixels than a screen takes four rays per pixel instead of nine, if it takes
// more than one. It takes half of the time; neighbouring pixels hide the loss.
constexpr double kManyPixels = 4e6;
constexpr int kFewSamples = 2;

// Share of the largest shape: smaller shapes can hardly be seen at its scale.
constexpr double kSmall = 0.05;

void check_options(const Options& options) {
  if (options.output == "-" && options.format.empty()) {
    throw UsageError("standard output has no extension; give --format png");
  }
  if (options.output != "-" && options.format.empty() && extension_of(options.output) != ".png") {
    throw UsageError(fmt::format("'{}' must end in .png", options.output));
  }
  if (options.color == "error" && options.against.empty()) {
    throw UsageError("--color error needs --against SHAPE, the surface to measure from");
  }
  if (!options.against.empty() && options.color != "error") {
    throw UsageError("--against needs --color error");
  }
}

// Least angle between sight and up, in radians; below it rounding would decide the up direction.
constexpr double kLeastAngle = 1e-6;

RenderOptions render_options(const Options& options, std::size_t panels) {
  RenderOptions wanted = options.render;
  const int n = static_cast<int>(std::min<std::size_t>(panels, 40));
  wanted.width = n == 1 ? kSingleWidth : kPanelWidth * n;
  wanted.height = n == 1 ? kSingleHeight : kPanelHeight;
  if (!options.size.empty()) {
    const auto size = parse_size("--size", options.size, kMinSize, kMaxSize);
    wanted.width = size[0];
    wanted.height = size[1];
  }
  if (double(wanted.width) * wanted.height > kManyPixels) wanted.samples = kFewSamples;
  wanted.fit_each = options.fit == "each";
  if (!options.view.empty()) wanted.view = parse_direction("--view", options.view);
  const auto along_view = [&](const Vec3& up) {
    return norm(cross(normalized(wanted.view), normalized(up))) < kLeastAngle;
  };
  if (!options.up.empty()) {
    wanted.up = parse_direction("--up", options.up);
    if (along_view(wanted.up)) {
      throw UsageError(
          fmt::format("--up is '{}', parallel to --view; give another direction", options.up));
    }
  } else if (along_view(wanted.up)) {
    wanted.up = {0, 1, 0};  // seen from above or below, as on a map
  }
  return wanted;
}

void add_panel(Mesh mesh, const std::string& label, bool smooth, Scene& scene) {
  scene.meshes.push_back(std::move(mesh));
  scene.panels.push_back(
      {.mesh = &scene.meshes.back(), .label = label, .scalars = {}, .smooth = smooth});
}

void add_points(ShapeFile file, const std::string& path, const std::string& label, Session& session,
                Scene& scene) {
  say_what_was_read(file, path, session);
  scene.clouds.push_back(std::get<PointCloud>(std::move(file.shape)));
  scene.panels.push_back({.label = label, .points = &scene.clouds.back()});
}

// Returns the vertices, or points, of a panel.
const std::vector<Vec3>& places(const Panel& panel) {
  return panel.points != nullptr ? panel.points->points : panel.mesh->vertices;
}

// Adds one panel for a shape, or one for each wanted degree of a model.
void add_input(const Options& options, const std::string& path, Session& session, Scene& scene) {
  Input input = read_surface_input(path, session, options.convention, options.columns);
  scene.unit.add(input, path, session);
  const std::string name = path == "-" ? "input" : std::filesystem::path(path).stem().string();
  auto* shape = std::get_if<ShapeFile>(&input);
  if (shape && std::holds_alternative<PointCloud>(shape->shape)) {
    return add_points(std::move(*shape), path, name, session, scene);
  }
  const auto* file = std::get_if<CoefficientsFile>(&input);
  if (!file || options.degrees.empty()) {
    const std::string label =
        file ? fmt::format("{}, L = {}", name, file->expansion.coefficients.degree()) : name;
    add_panel(surface_of(input, path, {}, options.subdivisions, session), label,
              file || !options.flat, scene);
    return;
  }
  for (const int degree : parse_degrees("--degree", options.degrees)) {
    add_panel(surface_of(input, path, degree, options.subdivisions, session),
              fmt::format("L = {}", degree), true, scene);
  }
}

void color_by_error(const Options& options, Session& session, Scene& scene, RenderOptions& wanted) {
  Input other = read_surface_input(options.against, session, options.convention);
  scene.unit.add(other, options.against, session);
  const Mesh surface = surface_of(other, options.against, {}, options.subdivisions, session);
  for (Panel& panel : scene.panels) {
    panel.scalars = distances_to_surface(places(panel), surface, session.context());
  }
  wanted.scale_min = 0;
  wanted.scale_max = options.scale_max;
  wanted.scale_label =
      fmt::format("distance to {}", std::filesystem::path(options.against).filename().string());
}

void color_by_own(const Options& options, Session& session, Scene& scene) {
  for (std::size_t i = 0; i < scene.panels.size(); ++i) {
    Panel& panel = scene.panels[i];
    panel.colors =
        panel.points != nullptr ? vertex_colors(*panel.points) : vertex_colors(*panel.mesh);
    if (!panel.colors.empty()) continue;
    session.warn(fmt::format("panel {} of {} has no attributes red, green, blue and stays plain",
                             i + 1, options.inputs.size()));
  }
}

void set_labels(const Options& options, Scene& scene) {
  if (options.labels.empty()) {
    if (scene.panels.size() == 1) scene.panels.front().label.clear();
    return;
  }
  const std::vector<std::string> labels = split(options.labels, ',');
  if (labels.size() != scene.panels.size()) {
    throw UsageError(
        fmt::format("--labels has {} names for {} panels", labels.size(), scene.panels.size()));
  }
  for (std::size_t i = 0; i < labels.size(); ++i) scene.panels[i].label = labels[i];
}

// Notes shapes that are too small to be seen beside the others.
void note_small(const Options& options, const Scene& scene, Session& session) {
  double largest = 0, smallest = std::numeric_limits<double>::infinity();
  for (const Panel& panel : scene.panels) {
    const double size = bounds(places(panel)).diagonal();
    largest = std::max(largest, size);
    smallest = std::min(smallest, size);
  }
  if (options.fit == "each" || !(smallest < kSmall * largest)) return;
  session.note(fmt::format(
      "the smallest shape has {:.2g} of the size of the largest; --fit each fills every panel",
      smallest / largest));
}

int run(const Options& options, Session& session) {
  check_options(options);
  render_options(options, 1);  // refuses wrong values before anything is read
  if (!options.degrees.empty()) parse_degrees("--degree", options.degrees);
  check_writable(options.output);
  Scene scene;
  for (const std::string& path : options.inputs) add_input(options, path, session, scene);
  set_labels(options, scene);
  note_small(options, scene, session);
  RenderOptions wanted = render_options(options, scene.panels.size());
  if (options.color == "error") color_by_error(options, session, scene, wanted);
  if (options.color == "own") color_by_own(options, session, scene);
  const Image image = render(scene.panels, wanted, session.context());
  stop_if_interrupted();
  write_png(options.output, image);
  return 0;
}

std::vector<Option> picture_options(Options& o) {
  return {
      {.name = "INPUT",
       .help = "files of meshes, points or coefficients",
       .target = &o.inputs,
       .required = true,
       .offer = Offer::kShapesAndCoefficients},
      {.name = "size",
       .value = "WxH",
       .help =
           "size of the picture in pixels; 1024x768 by default, 400x460 for each of several panels",
       .target = &o.size,
       .check = [](const std::string& option,
                   const std::string& text) { parse_size(option, text, kMinSize, kMaxSize); }},
      {.name = "color",
       .help = "error: colour by the distance to the surface of --against, with a scale bar; own: "
               "colours red, green, blue from the file; none by default",
       .target = &o.color,
       .choices = {"none", "error", "own"}},
      {.name = "against",
       .value = "SHAPE",
       .help = "mesh or coefficients from which --color error measures distances",
       .target = &o.against,
       .offer = Offer::kShapesAndCoefficients},
      {.name = "scale-max",
       .value = "D",
       .help = "distance at the top of the scale bar; by default the largest distance",
       .target = &o.scale_max,
       .above = 0},
      {.name = "degree",
       .value = "L[,L...]",
       .help = "degrees at which coefficients are cut off, with one panel for each",
       .target = &o.degrees,
       .check = parse_degrees},
      {.name = "labels",
       .value = "TEXT[,TEXT...]",
       .help = "text below each panel; by default the file and its degree",
       .target = &o.labels},
      {.name = "view",
       .value = "X,Y,Z",
       .help = "direction from the eye into the scene; -0.55,0.75,-0.4 by default",
       .target = &o.view,
       .check = parse_direction},
      {.name = "up",
       .value = "X,Y,Z",
       .help = "direction that points up in the picture; 0,0,1 by default, or 0,1,0 if the view is "
               "along 0,0,1",
       .target = &o.up,
       .check = parse_direction},
      {.name = "fit",
       .help = "scale: one scale for all panels; each: every panel filled; scale by default",
       .target = &o.fit,
       .choices = {"scale", "each"}},
      {.name = "flat",
       .help = "show the faces of a mesh, even if its file has normals",
       .target = &o.flat},
      field_option_of(o.render, "perspective"),
      field_option_of(o.render, "fine"),
      {.name = "subdivisions",
       .value = "N",
       .help = "subdivisions of the icosphere that samples coefficients; by default the smallest N "
               "from 5 to 8 with 16 (L+1)^2 vertices",
       .target = &o.subdivisions,
       .min = 0,
       .max = 12},
      output_option(o.output, "picture to write: .png; - for standard output"),
      format_option(o.format, {"png"})};
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = picture_options(o);
  append(list, input_convention_options(o.convention));
  list.push_back(columns_option(o.columns));
  return list;
}

}  // namespace

Command render_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "render",
      .summary = "Draw a picture of meshes, points or models",
      .description =
          "Draws meshes, points and the surfaces of coefficients as a PNG picture. Several inputs, "
          "or several degrees of one model, stand side by side at the same scale.\n\nPoints are "
          "balls as large as the distance between points. A mesh whose file has normals is shaded "
          "by these normals; --flat shows its faces. Pictures of more than four million pixels "
          "take four rays per pixel instead of nine. Pixels inside a surface share their light and "
          "take one ray, unless --fine is given.",
      .options = in_groups(
          option_list(*options),
          {{Group::kOutput, {"size", "color", "view"}},
           {Group::kAdvanced, {"scale-max", "labels", "up", "fit", "flat", "subdivisions"}}}),
      .examples =
          {"rholm render bumpy.h5 --degree 2,8,32 --size 720x240 -o levels.png",
           "rholm render bumpy.h5 bumpy.ply --fit each --size 480x240 -o both.png",
           "rholm render bumpy.h5 --color error --against bumpy.ply --size 480x360 -o error.png"},
      .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
