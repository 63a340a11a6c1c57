// rholm repair: repairs damaged meshes.
#include "rholm/repair.h"

#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/prepare.h"
#include "cli/grammar/parse.h"
#include "cli/options/field_options.h"
#include "cli/terminal/field_json.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  RepairOptions repair;
  std::string output;
  std::string format;
  bool ascii = false;
  bool json = false;
};

Json report_json(const RepairReport& r, const Options& options) {
  Json json = {{"file", options.input},
               {"weld", options.repair.weld},
               {"max_hole", options.repair.max_hole}};
  json.update(json_of_fields(r));
  json["before"] = json_of(r.before);
  json["after"] = json_of(r.after);
  return json;
}

// Returns the list, or `nothing` if it is empty.
std::string list_or(const std::string& list, const char* nothing) {
  return list.empty() ? nothing : list;
}

void add(std::string& list, std::size_t n, const std::string& text) {
  if (n > 0) list += (list.empty() ? "" : ", ") + text;
}

std::string state_of(const Inspection& i) {
  std::string text = i.closed ? "closed" : "open, " + counted(i.boundary_edges, "boundary edge");
  text += i.manifold ? ", manifold" : ", not manifold";
  text += i.oriented ? ", oriented" : ", faces disagree at " + counted(i.misoriented_edges, "edge");
  add(text, i.duplicate_faces, counted(i.duplicate_faces, "duplicate face"));
  add(text, i.degenerate_faces, counted(i.degenerate_faces, "face") + " thinner than rounding");
  text += ", " + counted(i.components, "component");
  if (i.closed && i.oriented) text += ", volume " + text_of(i.volume);
  return text;
}

std::string dropped_text(const RepairReport& r) {
  std::string list;
  add(list, r.duplicate_faces, counted(r.duplicate_faces, "duplicate face"));
  add(list, r.degenerate_faces, counted(r.degenerate_faces, "face") + " thinner than rounding");
  add(list, r.isolated_vertices,
      counted(r.isolated_vertices, "vertex", "vertices") + " in no face");
  return list_or(list, "nothing");
}

std::string turned_text(const RepairReport& r) {
  std::string list;
  add(list, r.flipped_faces, counted(r.flipped_faces, "face"));
  add(list, r.inside_out_parts, counted(r.inside_out_parts, "closed part") + " as a whole");
  return list_or(list, "nothing");
}

std::string report_text(const RepairReport& r) {
  std::string text;
  text += line("before", state_of(r.before));
  text += line("welded",
               fmt::format("{}, {} collapsed", counted(r.merged_vertices, "vertex", "vertices"),
                           counted(r.collapsed_faces, "face")));
  text += line("dropped", dropped_text(r));
  if (r.junctions > 0) {
    text += line("joined", counted(r.junctions, "vertex", "vertices") + " on edges of other faces");
  }
  if (r.split_vertices > 0) {
    text += line("split", counted(r.split_vertices, "vertex", "vertices") + " between sheets");
  }
  text += line("turned", turned_text(r));
  if (r.cavities > 0) {
    text += line("cavities", counted(r.cavities, "part") + " within others, facing inwards");
  }
  text += line("holes closed",
               fmt::format("{}, with {}", r.closed_holes, counted(r.hole_faces, "new face")));
  return text + line("after", state_of(r.after));
}

// Warns of remaining defects, with advice.
void warn_of_rest(const RepairReport& r, const Options& options, Session& session) {
  if (r.large_holes > 0) {
    session.warn(
        fmt::format("{} left open: larger than the {} edges of --max-hole, and the largest has {}",
                    counted(r.large_holes, "hole"), options.repair.max_hole, r.largest_hole));
  }
  if (r.sheets > 0) {
    session.warn(
        fmt::format("{} left open: an open sheet, whose cover would have more than 3/4 of its area",
                    counted(r.sheets, "border")));
  }
  if (r.one_sided_parts > 0) {
    session.warn(fmt::format(
        "{} left unchanged: surfaces with one side, for example Moebius strips, cannot be oriented",
        counted(r.one_sided_parts, "part")));
  }
  if (r.after.degenerate_faces > 0) {
    session.warn(fmt::format("{} thinner than rounding left unchanged",
                             counted(r.after.degenerate_faces, "face")));
  }
  if (r.after.non_manifold_edges + r.after.non_manifold_vertices > 0) {
    session.warn(fmt::format("still not manifold: {}, {}",
                             counted(r.after.non_manifold_edges, "edge"),
                             counted(r.after.non_manifold_vertices, "vertex", "vertices")));
  }
  if (r.closes_at) {
    session.warn(fmt::format("borders are within {:.2g} of each other; --weld {:.2g} joins them",
                             *r.closes_at, *r.closes_at));
  }
}

int run(const Options& options, Session& session) {
  const ShapeFormat format = mesh_output(options.output, options.format, options.json);
  check_writable(options.output);
  const Mesh mesh = read_mesh(options.input, session);
  const Repaired result = repair(mesh, options.repair, session.context());
  stop_if_interrupted();
  if (result.mesh.faces.empty()) {
    throw Error(ErrorCode::kInvalidInput,
                fmt::format("{} has no face with an area, and nothing can be written",
                            display_name(options.input)));
  }
  write_shape_output(result.mesh, options.output, {format, options.ascii}, session);
  if (options.json) {
    print_json(report_json(result.report, options));
  } else if (options.output != "-") {
    session.report(fmt::format("{}: repaired\n", display_name(options.input)) +
                   report_text(result.report));
  }
  warn_of_rest(result.report, options, session);
  return 0;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = {mesh_operand(o.input), weld_option(o.repair.weld)};
  append(list, field_options(o.repair));
  append(list, mesh_output_options(o.output, o.format, o.ascii));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command repair_command() {
  auto options = std::make_shared<Options>();
  return {
      .name = "repair",
      .summary = "Repair a damaged mesh: join vertices, orient faces, close holes",
      .description =
          "Joins vertices, removes duplicate and degenerate faces and vertices without a face, "
          "orients all faces, and closes small holes. The report counts the changes and describes "
          "the mesh before and after.\n\nDegenerate faces are thinner than the rounding of their "
          "coordinates. Sheets that touch at an edge of three or more faces, or at a vertex, are "
          "separated. They move apart by a millionth of the diagonal, because the next reader "
          "would join them again. Closed components face outwards; a closed component inside "
          "another one is the wall of a cavity and faces inwards. Holes are closed with flat "
          "faces. Colours and other attributes stay unchanged.\n\nWarnings name defects that "
          "remain: larger holes, borders of open sheets (a cover would have more than 3/4 of their "
          "area), and surfaces with one side. The exit code is 0 in these cases too.",
      .options = in_groups(option_list(*options), {{Group::kAccuracy, {"weld", "max-hole"}}}),
      .examples = {"rholm repair bumpy.ply -o repaired.ply",
                   "rholm repair bumpy.ply --weld 1e-6 --max-hole 20 --json -o repaired.ply"},
      .run = [options](Session& session) { return run(*options, session); },
      .per_shape = PerShape{.extension = "ply"}};
}

}  // namespace rholm::cli
