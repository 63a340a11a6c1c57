// rholm info: contents of a file.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/commands/atlas_report.h"
#include "cli/commands/commands.h"
#include "cli/commands/measures_report.h"
#include "cli/files/inputs.h"
#include "cli/files/memory_needed.h"
#include "cli/files/paths.h"
#include "cli/files/prepare.h"
#include "cli/options/memory_options.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/atlas_model.h"
#include "rholm/descriptors.h"
#include "rholm/error.h"
#include "rholm/formats.h"
#include "rholm/large_mesh.h"
#include "rholm/model.h"
#include "rholm/point_stream.h"
#include "rholm/repair.h"
#include "rholm/rms_beyond.h"
#include "rholm/synthesize.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  double weld = 0;
  MemoryOptions memory;
  InputConvention convention;
  std::string columns;
  bool json = false;
};

// Reading a mesh, welding it and pairing its edges takes 3.8 times the size of its binary file
// (scripts/memory-figures), and more if faces do not share corners. Points take three times the
// size.
constexpr double kMemoryPerByte = 6;
// Bytes per vertex and face of a mesh in memory: together 92 per face of a sphere, 152 if no two
// faces share corners (scripts/memory-figures).
constexpr MemoryOfMesh kLookedAt = {.vertex = 30, .face = 108};

struct MeshReport {
  const ShapeFile& file;
  const Welded& welded;
  Inspection inspection;
  std::size_t vertices_read;
  std::size_t faces_read;
  std::optional<double> closes_at;  // tolerance that welds its borders

  bool solid() const { return inspection.closed && inspection.oriented; }
  std::size_t isolated() const {
    return vertices_read - welded.merged_vertices - welded.mesh.vertices.size();
  }
};

Json mesh_json(const MeshReport& report, double tolerance) {
  const Inspection& i = report.inspection;
  Json json;
  json["counts"] = {{"vertices", i.vertices}, {"faces", i.faces}, {"edges", i.edges}};
  json["as_read"] = {{"vertices", report.vertices_read}, {"faces", report.faces_read}};
  json["weld"] = {{"tolerance", tolerance},
                  {"merged_vertices", report.welded.merged_vertices},
                  {"collapsed_faces", report.welded.collapsed_faces}};
  json.update(json_of(i));
  for (const char* counted : {"vertices", "faces", "edges"}) json.erase(counted);
  json["isolated_vertices"] = report.isolated();
  json["closes_at"] = json_of(report.closes_at);
  json["attributes"] = json_of(report.welded.mesh.attributes);
  return json;
}

std::string manifold_text(const Inspection& i) {
  return yes_or(i.manifold, fmt::format("{} in three or more faces, {} in more than one fan",
                                        counted(i.non_manifold_edges, "edge"),
                                        counted(i.non_manifold_vertices, "vertex", "vertices")));
}

// Areas and volumes of shapes of size 1e150 or 1e-150 are outside the range of doubles.
std::string measure_text(double value, bool must_differ_from_zero) {
  if (std::isinf(value)) return "above 1.8e308, the largest number; use another unit of length";
  if (value == 0 && must_differ_from_zero) {
    return "below 4.9e-324, the smallest number; use another unit of length";
  }
  return text_of(value);
}

// Returns the defects of a mesh, and how to repair them.
std::string advice_text(const MeshReport& report) {
  const Inspection& i = report.inspection;
  std::string text;
  if (report.closes_at) {
    text +=
        line("borders", fmt::format("are within {0:.2g} of each other; --weld {0:.2g} joins them",
                                    *report.closes_at));
  }
  const bool damaged = i.boundary_edges + i.non_manifold_edges + i.non_manifold_vertices +
                           i.misoriented_edges + i.degenerate_faces + i.duplicate_faces >
                       0;
  if (damaged && i.faces > 0) {
    text += line("repair with", report.closes_at
                                    ? fmt::format("rholm repair --weld {:.2g}", *report.closes_at)
                                    : "rholm repair");
  }
  return text;
}

std::string mesh_text(const MeshReport& report) {
  const Inspection& i = report.inspection;
  std::string text;
  text += line("vertices",
               fmt::format("{} ({} in the file, {} merged, {} in no face)", i.vertices,
                           report.vertices_read, report.welded.merged_vertices, report.isolated()));
  text += line("faces", fmt::format("{} ({} in the file, {} collapsed)", i.faces, report.faces_read,
                                    report.welded.collapsed_faces));
  text += line("edges", fmt::format("{}", i.edges));
  text += line("closed", yes_or(i.closed, counted(i.boundary_edges, "boundary edge")));
  text += line("manifold", manifold_text(i));
  text += line("oriented", yes_or(i.oriented, counted(i.misoriented_edges, "edge") +
                                                  " between faces that disagree"));
  text += line("inside out", i.inside_out ? "yes (expand turns it right side out)" : "no");
  text += line("components", fmt::format("{}", i.components));
  if (i.closed && i.manifold) text += line("genus", fmt::format("{}", i.genus));
  text += line("degenerate",
               counted(i.degenerate_faces, "face") + " thinner than the rounding of coordinates");
  text += line("duplicate", counted(i.duplicate_faces, "face"));
  text += line("bounds", fmt::format("{} to {}", text_of(i.bounds.min), text_of(i.bounds.max)));
  text += line("diagonal", measure_text(i.bounds.diagonal(), false));
  const bool has_area = i.degenerate_faces < i.faces;
  text += line("area", measure_text(i.area, has_area));
  // A flat solid has no volume. A volume too small for the area cannot be computed.
  text += line("volume", report.solid() ? measure_text(i.volume, has_area && i.area < 1e-200)
                                        : "none: not a solid");
  if (report.solid()) text += line("volume centroid", text_of(i.volume_centroid));
  text += line("attributes", text_of(report.welded.mesh.attributes));
  return text + advice_text(report);
}

bool has_direction(const PointCloud& cloud) {
  return std::any_of(cloud.normals.begin(), cloud.normals.end(),
                     [](const Vec3& n) { return !(n == Vec3{}); });
}

Json cloud_json(const PointCloud& cloud) {
  Json json;
  json["counts"] = {{"points", cloud.points.size()}};
  json["normals"] = has_direction(cloud);
  json["bounds"] = json_of(bounds(cloud.points));
  json["attributes"] = json_of(cloud.attributes);
  return json;
}

// Describes points; `n` is their number.
std::string cloud_text(const PointCloud& cloud, std::uint64_t n) {
  const Bounds box = bounds(cloud.points);
  const char* given = cloud.normals.empty() ? "no" : "no: all of them are zero";
  return line("points", fmt::format("{}", n)) +
         line("normals", has_direction(cloud) ? "yes" : given) +
         line("bounds", fmt::format("{} to {}", text_of(box.min), text_of(box.max))) +
         line("diagonal", text_of(box.diagonal())) + line("attributes", text_of(cloud.attributes));
}

// Adds the meaning of a text table's columns, as a line and in JSON.
void add_table(const TableColumns& table, std::string& text, Json& json) {
  if (table.note.empty()) return;
  std::vector<std::string> names, taken_for;
  for (const TableColumn& column : table.columns) {
    names.push_back(column.name);
    taken_for.push_back(column.taken_for);
  }
  json["table_columns"] = taken_for;
  json["table_names"] = names;
  json["table_unsure"] = table.unsure;
  json["table_note"] = table.note;
  text += line(table.unsure ? "unsure" : "table", table.note);
}

int report_shape(const Options& options, const ShapeFile& file) {
  const auto* mesh = std::get_if<Mesh>(&file.shape);
  Json json;
  json["file"] = options.input;
  json["kind"] = mesh ? "mesh" : "points";
  json["format"] = to_string(file.format);
  json["encoding"] = file.encoding;
  std::string text = fmt::format("{}: {}, {}, {}\n", display_name(options.input),
                                 mesh ? "mesh" : "points", to_string(file.format), file.encoding);
  if (mesh) {
    const Welded welded = weld(*mesh, options.weld);
    const MeshReport report{file,
                            welded,
                            inspect(welded.mesh),
                            mesh->vertices.size(),
                            mesh->faces.size(),
                            closing_tolerance(welded.mesh)};
    json.update(mesh_json(report, options.weld));
    text += mesh_text(report);
  } else {
    json.update(cloud_json(std::get<PointCloud>(file.shape)));
    const auto& cloud = std::get<PointCloud>(file.shape);
    text += cloud_text(cloud, cloud.points.size());
  }
  add_table(file.table, text, json);
  json["warnings"] = file.warnings;
  for (const std::string& warning : file.warnings) text += line("warning", warning);
  options.json ? print_json(json) : print_text(text);
  return 0;
}

std::string survey_text(const MeshView& mesh, const MeshSurvey& survey, double needed) {
  const auto gib = fmt::format("unknown: about {:.2g} GiB are needed", needed / 0x1p30);
  return line("vertices", fmt::format("{}", mesh.n_vertices)) +
         line("faces", fmt::format("{}", mesh.n_faces)) +
         line("closed", survey.closed ? "yes" : "no, or not oriented, or its vertices not joined") +
         line("topology", gib) +
         line("bounds",
              fmt::format("{} to {}", text_of(survey.bounds.min), text_of(survey.bounds.max))) +
         line("diagonal", measure_text(survey.bounds.diagonal(), false)) +
         line("area", measure_text(survey.area, false)) +
         line("volume", survey.closed ? measure_text(survey.volume, false) : "none: not a solid") +
         (survey.closed ? line("volume centroid", text_of(survey.volume_centroid)) : "");
}

// Reports on a mapped mesh everything that needs no adjacency of faces.
bool report_large_mesh(const Options& options, double needed, Session& session) {
  const std::optional<MappedMesh> mesh = map_mesh(options.input, session.context());
  if (!mesh || !has_triangles_only(*mesh, session.context())) return false;
  const MeshView& view = mesh->view();
  const MeshSurvey survey = survey_mesh(*mesh, session.context());
  Json json;
  json["file"] = options.input;
  json["kind"] = "mesh";
  json["format"] = "ply";
  json["topology"] = nullptr;
  json["counts"] = {{"vertices", view.n_vertices}, {"faces", view.n_faces}};
  json["closed"] = survey.closed;
  json["bounds"] = json_of(survey.bounds);
  json["area"] = survey.area;
  json["volume"] = survey.closed ? Json(survey.volume) : Json(nullptr);
  json["volume_centroid"] = survey.closed ? json_of(survey.volume_centroid) : Json(nullptr);
  options.json
      ? print_json(json)
      : print_text(fmt::format("{}: mesh, ply, larger than memory\n", display_name(options.input)) +
                   survey_text(view, survey, needed));
  return true;
}

// Reports on the points of a file, read in portions.
bool report_large_cloud(const Options& options, Session& session) {
  const std::optional<ShapeFormat> named = shape_format_of(options.input);
  if (!named || !shape_format_info(*named).in_pieces) return false;
  if (coefficients_format_of(options.input)) return false;  // their lines look like points
  PointStream stream(options.input, {.columns = options.columns});
  if (stream.has_faces()) return false;
  constexpr std::size_t kPiece = std::size_t{1} << 18;  // chosen: about 10 MB
  PointCloud piece;
  PointCloud seen;  // smallest and largest coordinates, and the attributes
  while (stream.read(kPiece, piece, session.context())) {
    const Bounds box = bounds(piece.points);
    seen.points.push_back(box.min);
    seen.points.push_back(box.max);
    const Bounds all = bounds(seen.points);
    seen.points = {all.min, all.max};
    if (has_direction(piece)) seen.normals = {Vec3{0, 0, 1}};
    if (!piece.normals.empty() && seen.normals.empty()) seen.normals = {Vec3{}};
    seen.attributes = std::move(piece.attributes);
    for (Attribute& attribute : seen.attributes) attribute.values.clear();
    stop_if_interrupted();
  }
  Json json = {{"file", options.input},
               {"kind", "points"},
               {"format", to_string(stream.format())},
               {"encoding", stream.encoding()}};
  json.update(cloud_json(seen));
  json["counts"] = {{"points", stream.read_so_far()}};
  std::string text = fmt::format("{}: points, {}, {}\n", display_name(options.input),
                                 to_string(stream.format()), stream.encoding());
  text += cloud_text(seen, stream.read_so_far());
  add_table(stream.table(), text, json);
  json["warnings"] = stream.warnings();
  for (const std::string& warning : stream.warnings()) text += line("warning", warning);
  options.json ? print_json(json) : print_text(text);
  return true;
}

// Returns true if a shape is too large to be read, and was reported in another way.
bool report_large(const Options& options, Session& session) {
  std::error_code none;
  const double needed =
      kMemoryPerByte * static_cast<double>(std::filesystem::file_size(options.input, none));
  if (none || needed <= static_cast<double>(options.memory.limit())) return false;
  return report_large_mesh(options, needed, session) || report_large_cloud(options, session);
}

// Returns the truncation error from the norm if none was measured, or that it is unknown.
std::string unmeasured_text(const Expansion& expansion) {
  if (expansion.function == RadialFunction::kOther) return "";
  const char* what = expansion.function == RadialFunction::kGauge ? "error of 1/r" : "radial error";
  const RmsBeyond beyond = rms_beyond(expansion);
  if (const std::optional<double>& rms = beyond.rms.back()) {
    return line(what, text_of(*rms) + " rms over solid angle, by the norm");
  }
  const std::optional<double> bound = beyond.bound();
  return line(
      what,
      bound ? fmt::format("not known, at most {} rms over solid angle{}", text_of(*bound),
                          beyond.precision_is_assumed
                              ? fmt::format(", if the precision is {}", text_of(beyond.precision))
                              : "")
            : "not known");
}

std::string errors_text(const TruncationErrors& errors) {
  const auto length = [&](double value) {
    return errors.diagonal > 0 ? fmt::format("{} ({} of the diagonal)", text_of(value),
                                             text_of(value / errors.diagonal))
                               : text_of(value);
  };
  std::string text;
  const auto add = [&](const char* name, const std::optional<double>& value, const char* how) {
    if (value) text += line(name, length(*value) + how);
  };
  add("radial error", errors.rms,
      errors.rms_is_exact ? " rms over solid angle, exact" : " rms over solid angle, measured");
  add("", errors.measured_max, " at most, measured");
  add("", errors.max_bound, " at most anywhere, a bound");
  add("", errors.predicted_max, " at most at vertices, predicted");
  add("distance", errors.distance_rms, " rms over area, measured");
  add("", errors.measured_max_distance, " at most, measured");
  add("", errors.predicted_max_distance, " at most at vertices, predicted");
  return text;
}

int report_coefficients(const Options& options, const CoefficientsFile& file, Session& session) {
  const Expansion& expansion = file.expansion;
  const bool model = options.input != "-" && is_model_file(options.input);
  const std::string format = model ? "model" : to_string(file.format);
  const std::string convention = fmt::format(
      "{}, csphase {}", to_string(file.convention.normalization), file.convention.csphase);
  const auto [measures, why_not] = measures_of(expansion, session.context());
  if (!why_not.empty()) session.note(fmt::format("volume and area are unknown: {}", why_not));
  Json json;
  json["file"] = options.input;
  json["kind"] = "coefficients";
  json["format"] = format;
  json["degree"] = expansion.coefficients.degree();
  json["function"] = to_string(expansion.function);
  json["center"] = json_of(expansion.center);
  json["unit"] = expansion.unit;
  json["method"] = expansion.method;
  json["normalization"] = to_string(file.convention.normalization);
  json["csphase"] = file.convention.csphase;
  json["assumed"] = file.assumed;
  json["product"] = file.product.empty() ? Json(nullptr) : Json(file.product);
  json["passed_over"] = file.passed_over;
  json["norm_squared"] = json_of(expansion.norm_squared);
  json["tail_strength"] = json_of(expansion.tail_strength);
  json["truncation_rms"] = json_of(rms_beyond(expansion).rms.back());
  json["errors"] = json_of(expansion.errors);
  json["diagonal"] = expansion.errors ? Json(expansion.errors->diagonal) : Json(nullptr);
  json["precision"] = json_of(expansion.precision);
  json["signed_sum"] = expansion.signed_sum;
  const std::optional<GravityField>& gravity = expansion.gravity;
  json["gravity_constant"] = gravity ? Json(gravity->gravity_constant) : Json(nullptr);
  json["reference_radius"] = gravity ? Json(gravity->reference_radius) : Json(nullptr);
  json.update(measures_json(measures));
  std::string text = fmt::format("{}: coefficients, {}\n", display_name(options.input), format);
  text += line("degree", fmt::format("{}", expansion.coefficients.degree()));
  text += line("function", to_string(expansion.function));
  text += line("centre", text_of(expansion.center));
  text += line("unit", expansion.unit.empty() ? "not said" : expansion.unit);
  text += line("method", expansion.method.empty() ? "not said" : expansion.method);
  text += line("precision", expansion.precision ? text_of(*expansion.precision) : "not said");
  text += line("numbers in", convention);
  for (const std::string& assumed : file.assumed) text += line("assumed", assumed);
  if (!file.product.empty()) text += line("of", file.product + ", no shape");
  if (gravity) text += line("relative to", text_of(*gravity));
  for (const std::string& what : file.passed_over) text += line("not used", what);
  if (measures && measures->volume && measures->area && measures->centroid) {
    for (const Descriptor& one : descriptors()) {
      if (const auto value = one.value(*measures)) text += line(one.name, text_of(*value));
    }
    text += line("volume centroid", text_of(*measures->centroid));
  }
  if (expansion.signed_sum) {
    text += line("signed sum", "of a surface that is not star-shaped");
    text += line("volume, area", "unknown: the values of the sum are not those of the body");
  }
  text += expansion.errors ? errors_text(*expansion.errors) : unmeasured_text(expansion);
  options.json ? print_json(json) : print_text(text);
  return 0;
}

int run(const Options& options, Session& session) {
  if (holds_atlas(options.input)) return report_atlas(options.input, options.json);
  options.memory.keep(session);
  if (report_large(options, session)) return 0;
  require_to_read(options.input, options.memory, kLookedAt);
  const Input input = read_input(options.input, session, options.convention, options.columns);
  if (const auto* file = std::get_if<ShapeFile>(&input)) {
    if (const auto* mesh = std::get_if<Mesh>(&file->shape)) {
      options.memory.require(kLookedAt.of(mesh->vertices.size(), mesh->faces.size()),
                             "looking at " + display_name(options.input));
    }
    return report_shape(options, *file);
  }
  return report_coefficients(options, std::get<CoefficientsFile>(input), session);
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = {
      {.name = "SHAPE",
       .help = "file of a mesh, of points or of coefficients, or - for standard input",
       .target = &o.input,
       .required = true,
       .offer = Offer::kShapesAndCoefficients},
      weld_option(o.weld),
      columns_option(o.columns),
      max_memory_option(o.memory)};
  append(list, input_convention_options(o.convention));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command info_command() {
  auto options = std::make_shared<Options>();
  return {.name = "info",
          .summary = "Describe a file: a mesh, points or coefficients",
          .description =
              "Prints what a file contains and what can be done with it. For a mesh: whether it is "
              "closed, manifold and oriented, its components, genus, area and volume. For points: "
              "their number and whether they have normals. For coefficients: degree, centre, "
              "convention, and " +
              descriptor_names() +
              " of the surface.\n\nThe content of the file decides its kind, and its name does not "
              "matter. An open mesh or one that is inside out is no error: the exit code is "
              "0.\n\nA binary PLY mesh that needs more memory than --max-memory is read in place. "
              "Its topology is then left out, except whether it is closed.",
          .options = in_groups(option_list(*options), {{Group::kData, {"weld"}}}),
          .examples = {"rholm info bumpy.ply", "rholm info bumpy.ply --json"},
          .run = [options](Session& session) { return run(*options, session); },
          .per_shape = PerShape{}};
}

}  // namespace rholm::cli
