// rholm simplify: fewer faces for the same surface.
#include "rholm/simplify.h"

#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/parse.h"
#include "cli/options/simplify_option.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/error.h"
#include "rholm/topology.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  std::string faces = "auto";
  std::optional<double> max_error;
  std::string output;
  std::string format;
  bool ascii = false;
  bool json = false;
};

// Error as a fraction of the mean edge, the same as reconstruct allows of its grid's step.
constexpr double kHardlyAnything = 0.02;

double mean_edge(const Mesh& mesh) {
  double sum = 0;
  const auto n = static_cast<double>(3 * mesh.faces.size());
  for (const Triangle& t : mesh.faces) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 edge = mesh.vertices[t[(k + 1) % 3]] - mesh.vertices[t[k]];
      sum += std::hypot(edge.x, edge.y, edge.z) / n;
    }
  }
  return sum;
}

SimplifyOptions library_options(const Options& o, SimplifyOptions wanted, const Mesh& mesh) {
  const bool automatic = wanted.faces == 0 && wanted.share == 0;
  if (o.max_error) {
    wanted.max_error = *o.max_error;
  } else if (automatic) {
    wanted.max_error = kHardlyAnything * mean_edge(mesh);
  }
  return wanted;
}

SimplifyOptions parse_faces(const std::string& option, const std::string& text) {
  const std::optional<SimplifyOptions> faces = parse_simplify(option, text);
  if (faces) return *faces;
  throw UsageError(
      fmt::format("{} is '{}', which changes nothing: give N, P% or auto", option, text));
}

int run(const Options& options, Session& session) {
  const SimplifyOptions faces = parse_faces("--faces", options.faces);
  const ShapeFormat format = mesh_output(options.output, options.format, options.json);
  check_writable(options.output);
  Mesh mesh = weld(read_mesh(options.input, session)).mesh;
  if (mesh.faces.empty()) {
    throw Error(
        ErrorCode::kInvalidInput,
        fmt::format("{} has no face: there is nothing to simplify", display_name(options.input)));
  }
  const std::size_t faces_before = mesh.faces.size(), vertices_before = mesh.vertices.size();
  const double diagonal = bounds(mesh.vertices).diagonal();
  const SimplifyOptions wanted = library_options(options, faces, mesh);
  const Simplification result = simplify(std::move(mesh), wanted, session.context());
  stop_if_interrupted();
  write_shape_output(result.mesh, options.output, {format, options.ascii}, session);
  const std::size_t n = result.mesh.faces.size();
  if (options.json) {
    print_json({{"file", options.input},
                {"faces_before", faces_before},
                {"faces", n},
                {"vertices_before", vertices_before},
                {"vertices", result.mesh.vertices.size()},
                {"error", result.error},
                {"diagonal", diagonal}});
  } else if (options.output != "-") {
    session.report(
        fmt::format("{}: simplified\n", display_name(options.input)) +
        line("faces", fmt::format("{} of {}", n, faces_before)) +
        line("vertices", fmt::format("{} of {}", result.mesh.vertices.size(), vertices_before)) +
        line("error", fmt::format("{} at most, rms over the planes a vertex stands for "
                                  "({} of the diagonal)",
                                  text_of(result.error), text_of(result.error / diagonal))));
  }
  if (faces.faces > 0 && n > faces.faces) {
    session.warn(
        fmt::format("{} faces are left, more than {}: the surface would turn over or lose "
                    "its shape",
                    n, faces.faces));
  }
  return 0;
}

std::vector<Option> option_list(Options& o) {
  std::vector<Option> list = {
      mesh_operand(o.input),
      {.name = "faces",
       .value = "auto|N|P%",
       .help = "number of faces to keep: N of them, P per cent, or auto; auto by default. With "
               "auto the surface changes by at most 1/50 of its mean edge",
       .target = &o.faces,
       .check = parse_faces},
      {.name = "max-error",
       .value = "D",
       .help = "largest rms distance of a vertex from the planes of its original faces, in the "
               "unit of the shape; no limit by default",
       .target = &o.max_error,
       .min = 0}};
  append(list, mesh_output_options(o.output, o.format, o.ascii));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command simplify_command() {
  auto options = std::make_shared<Options>();
  return {.name = "simplify",
          .summary = "Reduce the number of faces of a mesh",
          .description =
              "Collapses edges of a mesh, beginning with the edges that change the surface least. "
              "It stops at the wanted number of faces, or where the error would exceed "
              "--max-error.\n\nA closed or manifold surface stays closed or manifold, with the "
              "same genus and borders. The remaining vertices keep their positions and attributes.",
          .options = in_groups(option_list(*options), {{Group::kAccuracy, {"faces", "max-error"}}}),
          .examples = {"rholm simplify bumpy.ply -o fewer.ply",
                       "rholm simplify bumpy.ply --faces 20% --json -o fewer.ply",
                       "rholm simplify bumpy.ply --faces 5000 --max-error 0.01 -o fewer.ply"},
          .run = [options](Session& session) { return run(*options, session); },
          .per_shape = PerShape{.extension = "ply"}};
}

}  // namespace rholm::cli
