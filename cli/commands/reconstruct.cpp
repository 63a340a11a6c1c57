// rholm reconstruct: surfaces from points.
#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "cli/options/simplify_option.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/compress.h"
#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/reconstruct.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::optional<double> tolerance;
  std::string noise = "auto";
  std::string sensor;
  std::string holes = "fill";
  std::string blend = "smooth";
  std::optional<int> resolution;
  double min_component = 0.01;
  std::string simplify = kNotSimplified;
  double max_memory = 8;
  bool keep_outliers = false;
  bool keep_scans = false;
  bool confidence = false;
  std::string model;
  std::string output;
  std::string format;
  bool ascii = false;
  bool json = false;
};

// Of a mesh the vertices, with the mean normals of their faces.
PointCloud points_of(Mesh mesh) {
  PointCloud cloud;
  cloud.normals = area_normals(mesh.vertices, mesh.triangles);
  std::erase_if(mesh.attributes, [](const Attribute& a) {
    return a.name == "nx" || a.name == "ny" || a.name == "nz";
  });
  cloud.points = std::move(mesh.vertices);
  cloud.attributes = std::move(mesh.attributes);
  return cloud;
}

PointCloud read_points(const std::string& path, Session& session) {
  ShapeFile file = read_shape_input(path, session);
  for (const std::string& warning : file.warnings) {
    session.warn(fmt::format("{}: {}", display_name(path), warning));
  }
  if (auto* cloud = std::get_if<PointCloud>(&file.shape)) return std::move(*cloud);
  Mesh& mesh = std::get<Mesh>(file.shape);
  session.note(fmt::format("{} is a mesh: its {} vertices are taken as points", display_name(path),
                           mesh.vertices.size()));
  return points_of(std::move(mesh));
}

void check_noise(const std::string& option, const std::string& text) {
  const std::optional<double> value = read_number(text);
  if (text == "auto" || (value && *value >= 0 && *value < 1)) return;
  throw UsageError(fmt::format(
      "{} is '{}'; it must be auto or a part of the diagonal from 0 up to below 1", option, text));
}

ReconstructOptions library_options(const Options& o, const Bounds& box) {
  ReconstructOptions options;
  const Vec3 size = box.max - box.min;
  if (o.resolution) options.step = std::max({size.x, size.y, size.z}) / *o.resolution;
  if (o.tolerance) options.tolerance = *o.tolerance * box.diagonal();
  if (o.noise != "auto") options.noise = *read_number(o.noise) * box.diagonal();
  options.holes = parse_hole_policy(o.holes);
  options.blend = parse_cap_blend(o.blend);
  options.min_component = o.min_component;
  options.remove_outliers = !o.keep_outliers;
  options.align_scans = !o.keep_scans;
  options.confidence = o.confidence;
  options.simplify = parse_simplify("--simplify", o.simplify);
  options.max_memory = static_cast<std::size_t>(o.max_memory * 0x1p30);
  return options;
}

Json json_of(const Reconstruction& made, double diagonal, bool confidence) {
  const ReconstructReport& r = made.report;
  Json json = {{"points", r.points},
               {"dropped_points", r.dropped_points},
               {"outliers", r.outliers},
               {"computed_normals", r.computed_normals},
               {"unsure", r.unsure},
               {"turned_normals", r.turned_normals},
               {"spacing", r.spacing},
               {"noise", r.noise},
               {"normal_noise_degrees", r.normal_noise_degrees},
               {"neighbours", r.neighbours},
               {"caps", r.caps},
               {"coefficients", made.atlas.coefficients.size()},
               {"step", r.step},
               {"holes", r.holes},
               {"smooth_holes", r.smooth_holes},
               {"cut_handles", r.cut_handles},
               {"dropped_components", r.dropped_components},
               {"vertices", made.mesh.vertices.size()},
               {"faces", made.mesh.triangles.size()},
               {"full_faces", r.faces},
               {"simplify_error", r.simplify_error},
               {"area", r.area},
               {"closed_area", r.closed_area},
               {"points_area", r.points_area},
               {"volume", r.volume},
               {"diagonal", diagonal},
               {"foreseen_memory", r.memory}};
  if (r.scans.scans > 1) {
    json["scans"] = {{"scans", r.scans.scans},
                     {"pairs", r.scans.pairs},
                     {"distance_before", r.scans.distance_before},
                     {"distance", r.scans.distance},
                     {"moved", r.scans.moved}};
  }
  if (confidence) {
    json["unseen_area"] = r.unseen_area;
    json["thin_area"] = r.thin_area;
    json["unsure_area"] = r.unsure_area;
  }
  for (const auto& [name, time] : r.times) {
    json["stages"][name] = {{"wall_seconds", time.wall}, {"cpu_seconds", time.cpu}};
  }
  return json;
}

std::string report_text(const Reconstruction& made, double diagonal,
                        const ReconstructOptions& options) {
  const ReconstructReport& r = made.report;
  const auto relative = [&](double length) {
    return fmt::format("{} ({:.3g} of the diagonal)", text_of(length), length / diagonal);
  };
  std::string text = line("points", fmt::format("{}", r.points));
  if (r.dropped_points > 0) {
    text += line("dropped",
                 fmt::format("{} (not finite, doubled, or without a normal)", r.dropped_points));
  }
  if (r.outliers > 0) text += line("outliers", fmt::format("{}, left out", r.outliers));
  if (r.scans.scans > 1) {
    text += line("scans", fmt::format("{}, {} apart, moved by {}: {} apart", r.scans.scans,
                                      text_of(r.scans.distance_before), text_of(r.scans.moved),
                                      text_of(r.scans.distance)));
  }
  if (r.computed_normals) {
    text +=
        line("normals", fmt::format("computed, as by rholm orient: {:.2f} % of their signs unsure",
                                    100 * r.unsure));
  }
  if (r.turned_normals) text += line("normals", "all pointed inwards, turned outwards");
  text += line("spacing", relative(r.spacing));
  text += line("noise", r.noise > 0 ? relative(r.noise) : "within what the caps explain");
  text += line("caps", fmt::format("{} of about {} points", r.caps, r.neighbours));
  text += line("grid", fmt::format("cubes of {}", relative(r.step)));
  if (r.holes > 0) {
    text += line("places without data", options.holes == HolePolicy::kKeep
                                            ? fmt::format("{}", r.holes)
                                            : fmt::format("{} closed, {} of them wide: smoothly",
                                                          r.holes, r.smooth_holes));
  }
  if (r.cut_handles > 0) text += line("small handles", fmt::format("{} cut", r.cut_handles));
  if (r.dropped_components > 0)
    text += line("small parts", fmt::format("{} dropped", r.dropped_components));
  if (made.mesh.triangles.size() < r.faces) {
    text += line("simplified", fmt::format("from {} faces, moved by at most {}", r.faces,
                                           relative(r.simplify_error)));
  }
  if (options.confidence) {
    text += line("not known",
                 fmt::format("{:.2f} % of the area is far from data, {:.2f} % thin, {:.2f} "
                             "% below a confidence of 1/2",
                             100 * r.unseen_area, 100 * r.thin_area, 100 * r.unsure_area));
  }
  return text + line("surface",
                     fmt::format("{}, {}", counted(made.mesh.vertices.size(), "vertex", "vertices"),
                                 counted(made.mesh.triangles.size(), "face")));
}

constexpr double kSaid = 0.02;  // share of unsure signs that is worth a warning

// Of the area that points stand for: less is worth a warning; noisy points have 0.8.
constexpr double kSaidArea = 0.7;

// Says what makes the surface doubtful; throws NotConverged where it should not be trusted. The
// output is written by then.
void judge(const Reconstruction& made, bool filled, Session& session) {
  const double unsure = made.report.unsure;
  const std::string side =
      fmt::format("the side of {:.3g} % of the normals is unsure", 100 * unsure);
  if (unsure > kTooUnsure) {
    throw Error(
        ErrorCode::kNotConverged,
        side +
            ": the surface, which is written, may be wrong all over; give normals, or where "
            "points were measured from (--sensor, attributes sensor_x, "
            "sensor_y, sensor_z)");
  }
  if (unsure > kSaid) {
    session.warn(side + ": thin or sparse parts may be wrong; --confidence shows where");
  }
  const double seen = made.report.area - made.report.closed_area;
  const double share = seen / made.report.points_area;
  const std::string much = fmt::format(
      "the surface has {:.3g} times the area that the points stand for: they contradict each "
      "other, "
      "as double walls or scans that are off do",
      share);
  if (share < kLeastArea || share > kMostArea) {
    throw Error(ErrorCode::kNotConverged, much + "; it is written, but may be wrong all over");
  }
  if (share < kSaidArea) session.warn(much);
  if (made.report.closed_area > made.report.points_area) {
    session.warn(
        "more of the surface closes holes than there are points for: the points are open, "
        "as of one side; --holes keep leaves them so");
  }
  if (filled && made.report.volume < 0) {
    throw Error(ErrorCode::kNotConverged,
                "the surface, which is written, encloses a negative volume: normals point inwards");
  }
}

int run(const Options& options, Session& session) {
  std::optional<Vec3> sensor;
  if (!options.sensor.empty()) sensor = parse_vector("--sensor", options.sensor);
  const ShapeFormat format = mesh_output(options.output, options.format, options.json);
  check_writable(options.output);
  if (!options.model.empty()) {
    if (options.model == "-") throw UsageError("a model file is written in place: --model NAME.h5");
    check_writable(options.model);
  }
  PointCloud cloud = read_points(options.input, session);
  validate(cloud);
  const Bounds box = bounds(cloud.points);
  ReconstructOptions wanted = library_options(options, box);
  wanted.sensor = sensor;
  const Reconstruction made = reconstruct(std::move(cloud), wanted, session.context());
  stop_if_interrupted();
  write_shape(made.mesh, options.output, {format, options.ascii}, session.context());
  // Last, as it is not interrupted: who reads that nothing was written finds nothing.
  if (!options.model.empty()) {
    write_atlas({.atlas = made.atlas,
                 .step = made.report.step,
                 .tolerance = wanted.tolerance,
                 .errors = {},
                 .input_numbers = 3 * made.report.points,
                 .unit = {},
                 .method = "reconstruct"},
                options.model);
  }
  if (options.json) {
    Json json;
    json["file"] = options.input;
    json.update(json_of(made, box.diagonal(), wanted.confidence));
    print_json(json);
  } else if (options.output != "-") {
    session.report(fmt::format("{}: reconstructed\n", display_name(options.input)) +
                   report_text(made, box.diagonal(), wanted));
  }
  judge(made, wanted.holes == HolePolicy::kFill, session);
  return 0;
}

std::vector<Option> option_list(Options& o) {
  return {
      {.name = "POINTS",
       .help = "file of points, or - for standard input; normals are computed if there are "
               "none",
       .target = &o.input,
       .required = true,
       .offer = Offer::kShapes},
      {.name = "tolerance",
       .value = "E",
       .help = "larger caps and a coarser surface, within this rms distance of the points; a "
               "part of the diagonal of the bounding box. By default as exact as the points",
       .target = &o.tolerance,
       .min = 0,
       .max = 1},
      {.name = "noise",
       .value = "auto|SIGMA",
       .help = "standard deviation of the points, a part of the diagonal; auto: estimated",
       .target = &o.noise,
       .check = check_noise},
      {.name = "holes",
       .help = "fill: close places without points; keep: leave them open",
       .target = &o.holes,
       .choices = {"fill", "keep"}},
      {.name = "blend",
       .help = "weights of caps that overlap: smooth; spline: the paper's quadratic B-spline",
       .target = &o.blend,
       .choices = {"smooth", "spline"}},
      {.name = "resolution",
       .value = "N",
       .help = "cubes of the grid along the longest side; by default from the spacing",
       .target = &o.resolution,
       .min = 4,
       .max = 65536},
      simplify_option(o.simplify),
      {.name = "min-component",
       .value = "SHARE",
       .help = "parts with less of the largest one's area are dropped; 0.01 by default",
       .target = &o.min_component,
       .min = 0,
       .max = 1},
      {.name = "keep-outliers", .help = "do not look for outliers", .target = &o.keep_outliers},
      {.name = "sensor",
       .value = "X,Y,Z",
       .help = "all points have been measured from here (without, attributes sensor_x, sensor_y, "
               "sensor_z say where each was): computed normals point there, and holes are not "
               "closed across what lines of sight go through",
       .target = &o.sensor},
      {.name = "keep-scans",
       .help = "leave points with an attribute scan where they are; else the scans are brought "
               "together first",
       .target = &o.keep_scans},
      {.name = "confidence",
       .help = "give each vertex its confidence, 0 ... 1, as an attribute: less where signs are "
               "unsure, far from data, and where the surface is thin",
       .target = &o.confidence},
      {.name = "max-memory",
       .value = "GIB",
       .help = "refuse what would need more; 8 by default",
       .target = &o.max_memory,
       .min = 0.01,
       .max = 65536},
      {.name = "model",
       .value = "FILE",
       .help = "write the caps to a model file, .h5, as well; rholm synthesize reads it",
       .target = &o.model,
       .offer = Offer::kAnyFile},
      output_option(o.output, "mesh to write: .ply, .obj, .off, .stl; - for standard output"),
      format_option(o.format, mesh_formats()),
      {.name = "ascii", .help = "PLY and STL as text", .target = &o.ascii},
      json_option(o.json)};
}

}  // namespace

Command reconstruct_command() {
  auto options = std::make_shared<Options>();
  return {.name = "reconstruct",
          .summary = "From points to a closed surface",
          .description =
              "Covers points with overlapping caps, each a function on a sphere of its own fitted "
              "to points and normals, blends them and extracts the surface: closed, 2-manifold, "
              "oriented outwards, with normals. Size of caps, noise and resolution are chosen from "
              "the data; outliers are left out, holes are closed smoothly, and colours and other "
              "properties of the points are carried over.",
          .options = option_list(*options),
          .examples = {"rholm reconstruct points.ply -o surface.ply",
                       "rholm reconstruct points.ply --holes keep --json -o surface.obj"},
          .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
