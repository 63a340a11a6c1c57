// rholm compare: distance between two surfaces.
#include "cli/commands/compare.h"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/files/length_units.h"
#include "cli/files/memory_needed.h"
#include "cli/files/paths.h"
#include "cli/files/surfaces.h"
#include "cli/options/field_options.h"
#include "cli/options/memory_options.h"
#include "cli/terminal/field_json.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/large_mesh.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string a;
  std::string b;
  CompareOptions compare;
  std::optional<int> subdivisions;
  MemoryOptions memory;
  InputConvention convention;
  bool json = false;
};

// Reading two meshes, sampling them and building their trees takes 6.3 times the size of their
// binary files of doubles (scripts/memory-figures), and more for floats.
constexpr double kMemoryPerByte = 9;
// Bytes per vertex and face of a mesh in memory: together 153 per face of a sphere, 339 if no two
// faces share corners (scripts/memory-figures).
constexpr MemoryOfMesh kCompared = {.vertex = 83, .face = 145};

double memory_of(const Mesh& mesh) { return kCompared.of(mesh.vertices.size(), mesh.faces.size()); }

Json report_json(const Options& options, const Comparison& c) {
  Json json = {{"a", options.a}, {"b", options.b}};
  json.update(json_of_fields(c));
  Comparison relative = c;
  scale_lengths(relative, 1 / c.diagonal);
  for (const char* part : {"a_to_b", "b_to_a", "hausdorff", "threshold"}) {
    json["relative"][part] = json_of_fields(relative)[part];
  }
  return json;
}

std::string distances_line(const std::string& name, const Distances& d, double diagonal) {
  return line(
      name, fmt::format("{:>11.4e} {:>11.4e} {:>11.4e}   {:>9.3e} {:>9.3e} {:>9.3e}", d.rms, d.mean,
                        d.max, d.rms / diagonal, d.mean / diagonal, d.max / diagonal));
}

std::string report_text(const Options& options, const Comparison& c) {
  std::string text =
      fmt::format("A is {}, B is {}\n", display_name(options.a), display_name(options.b));
  text += line("", fmt::format("{:>11} {:>11} {:>11}   {:>9} {:>9} {:>9}", "rms", "mean", "max",
                               "rms/diag", "mean/diag", "max/diag"));
  text += distances_line("A to B", c.a_to_b, c.diagonal);
  text += distances_line("B to A", c.b_to_a, c.diagonal);
  text += line("Hausdorff", fmt::format("{} ({:.3e} of the diagonal {})", text_of(c.hausdorff),
                                        c.hausdorff / c.diagonal, text_of(c.diagonal)));
  text += line("F-score", fmt::format("{:.6g} within {} (precision {:.6g}, recall {:.6g})",
                                      c.f_score, text_of(c.threshold), c.precision, c.recall));
  text += line("normals", fmt::format("{:.4g} degrees apart in the median, {:.4g} in the mean",
                                      c.normal_median_degrees, c.normal_mean_degrees));
  text += line("samples", fmt::format("{} on each, seed {}", c.samples, c.seed));
  return text;
}

// A surface in a mapped file, or in memory.
struct Place {
  std::optional<MappedMesh> mapped;
  Mesh mesh;

  MeshInPlace in_place() const {
    return mapped ? rholm::in_place(*mapped) : MeshInPlace{.mesh = view_of(mesh)};
  }
  std::size_t memory() const {
    return mesh.vertices.size() * sizeof(Vec3) + mesh.faces.size() * sizeof(Triangle);
  }
};

std::optional<MappedMesh> mapped_mesh(const std::string& path, Session& session) {
  std::optional<MappedMesh> mesh = map_mesh(path, session.context());
  if (mesh && !has_triangles_only(*mesh, session.context())) mesh.reset();
  return mesh;
}

double needed_memory(const Options& options) {
  double bytes = 0;
  for (const std::string& path : {options.a, options.b}) {
    std::error_code error;
    const auto size = std::filesystem::file_size(path, error);
    if (!error) bytes += static_cast<double>(size);
  }
  return kMemoryPerByte * bytes;
}

// Compares meshes that need more than --max-memory in their files; returns nothing for others.
std::optional<Comparison> compare_large(const Options& options, const CompareBy& by,
                                        Session& session) {
  const double needed = needed_memory(options);
  if (!by.compare_in_place || needed <= static_cast<double>(options.memory.limit())) return {};
  Place a{.mapped = mapped_mesh(options.a, session), .mesh = {}};
  Place b{.mapped = mapped_mesh(options.b, session), .mesh = {}};
  if (!a.mapped && !b.mapped) {
    session.note(
        fmt::format("about {:.2g} GiB are needed; only meshes of triangles in a binary PLY file "
                    "can be compared without a copy in memory",
                    needed / 0x1p30));
    return {};
  }
  CommonUnit unit;
  const auto read = [&](const std::string& path, Place& place) {
    if (place.mapped) return;
    require_to_read(path, options.memory);
    Input input = read_surface_input(path, session, options.convention);
    unit.add(input, path, session);
    place.mesh = surface_of(input, path, {}, options.subdivisions, session);
  };
  read(options.a, a);
  read(options.b, b);
  const std::size_t limit = options.memory.limit(), held = a.memory() + b.memory();
  return by.compare_in_place(a.in_place(), b.in_place(), limit > held ? limit - held : 0,
                             options.compare, session.context());
}

std::optional<Comparison> compare_read(const Options& options, const CompareBy& by,
                                       Session& session) {
  if (options.memory.gib) {
    const ShapeMemory a = memory_to_read(options.a), b = memory_to_read(options.b);
    options.memory.require(
        std::max({a.reading, a.kept() + b.reading, kCompared.of(a) + kCompared.of(b)}),
        fmt::format("reading {} and {}", display_name(options.a), display_name(options.b)));
  }
  Input first = read_surface_input(options.a, session, options.convention);
  Input second = read_surface_input(options.b, session, options.convention);
  CommonUnit unit;
  unit.add(first, options.a, session);
  unit.add(second, options.b, session);
  const Mesh a = surface_of(first, options.a, {}, options.subdivisions, session);
  const Mesh b = surface_of(second, options.b, {}, options.subdivisions, session);
  options.memory.require(
      memory_of(a) + memory_of(b),
      fmt::format("comparing {} and {}", display_name(options.a), display_name(options.b)));
  return by.compare(a, b, options.compare, session.context());
}

int run(const Options& options, const CompareBy& by, Session& session) {
  by.begin(options.a, options.b);
  options.memory.keep(session);
  std::optional<Comparison> comparison = compare_large(options, by, session);
  if (!comparison) comparison = compare_read(options, by, session);
  if (!comparison) return 0;
  if (options.json) {
    print_json(report_json(options, *comparison));
  } else {
    print_text(report_text(options, *comparison));
  }
  return 0;
}

std::vector<Option> option_list(Options& o, bool in_place) {
  const auto surface = [](const char* name, const char* help, std::string& target) {
    return Option{.name = name,
                  .help = help,
                  .target = &target,
                  .required = true,
                  .offer = Offer::kShapesAndCoefficients};
  };
  std::vector<Option> list = {
      surface("A", "file of the first surface: a mesh or coefficients", o.a),
      surface("B", "file of the second surface", o.b)};
  append(list, field_options(o.compare));
  list.push_back({.name = "subdivisions",
                  .value = "N",
                  .help = "subdivisions of the icosphere that samples coefficients; by default the "
                          "smallest N from 5 to 8 with 16 (L+1)^2 vertices",
                  .target = &o.subdivisions,
                  .min = 0,
                  .max = 12});
  if (in_place) list.push_back(max_memory_option(o.memory));
  append(list, input_convention_options(o.convention));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command compare_command() {
  return compare_command_by(
      {.begin = [](const std::string&, const std::string&) {},
       .compare = [](const Mesh& a, const Mesh& b, const CompareOptions& options,
                     const Context& context) { return compare(a, b, options, context); },
       .compare_in_place =
           [](const MeshInPlace& a, const MeshInPlace& b, std::size_t memory,
              const CompareOptions& options,
              const Context& context) { return compare(a, b, memory, options, context); }});
}

Command compare_command_by(const CompareBy& by) {
  auto options = std::make_shared<Options>();
  const bool in_place = static_cast<bool>(by.compare_in_place);
  return {
      .name = "compare",
      .summary = "Measure the distance between two surfaces",
      .description =
          "Measures distances from random points of each surface to the closest points of the "
          "other one. The report has the rms, mean and largest distance, the angle between "
          "normals, and the F-score.\n\nThe points are spread evenly over the area, and the "
          "closest points are exact. Distances are in the unit of the shape and as fractions of "
          "the diagonal of the bounding box of A. The largest distance is a lower bound of the "
          "Hausdorff distance. The F-score is the harmonic mean of the two shares of points within "
          "a threshold." +
          std::string(in_place ? "\n\nBinary PLY meshes that need more memory than --max-memory "
                                 "are read in place, with the same result."
                               : ""),
      .options = in_groups(option_list(*options, in_place),
                           {{Group::kAccuracy, {"samples"}}, {Group::kAdvanced, {"subdivisions"}}}),
      .examples = {"rholm compare bumpy.ply bumpy.h5",
                   "rholm compare bumpy.ply smooth.ply --samples 300000 --seed 7 --json"},
      .run = [options, by](Session& session) { return run(*options, by, session); }};
}

}  // namespace rholm::cli
