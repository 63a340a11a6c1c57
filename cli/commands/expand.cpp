// rholm expand: from a mesh to its coefficients.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/commands/commands.h"
#include "cli/commands/expand.h"
#include "cli/commands/expand_options.h"
#include "cli/commands/expand_report.h"
#include "cli/files/inputs.h"
#include "cli/files/memory_needed.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/files/prepare.h"
#include "cli/files/spooled_input.h"
#include "cli/grammar/parse.h"
#include "cli/terminal/freed_memory.h"
#include "cli/terminal/json_text.h"
#include "rholm/error.h"

namespace rholm::cli {
namespace {

using Options = ExpandCommandOptions;
using Run = ExpandRun;

ExpandOptions expand_options(const Options& options) {
  ExpandOptions wanted = options.expand.values;
  wanted.method = parse_name<Method>(options.method);
  wanted.tolerance = options.tolerance.parsed();
  wanted.errors = !options.no_errors;
  wanted.chart = chart_options(options.chart, options.center);
  wanted.weld_tolerance = options.weld;
  return wanted;
}

// scripts/memory-figures measures all these constants, in bytes, on spheres. The pass over a mapped
// mesh takes 48 bytes per thread and face, for at most 2^23 faces at a time. Faces in random order
// take 15 bytes each.
constexpr double kPassOfTriangle = 50, kOrderOfTriangle = 16;
constexpr double kMostOfPass = 1 << 23;
// A mesh that is read, welded and paired takes 214 bytes per face of a sphere, and 284 if no two
// faces share corners.
constexpr MemoryOfMesh kPairedMesh = {.vertex = 75, .face = 215};
// With --weld corners are merged before faces are paired: 190 and 245 bytes.
constexpr MemoryOfMesh kWeldedMesh = {.vertex = 45, .face = 190};
constexpr double kSmallMesh = 8 << 20, kMemoryOfCoefficient = 150;
// Distances to the surface, for the errors of coarse models, take another 102 MiB, for a box and
// degree 512 (scripts/memory-figures).
constexpr double kDistances = 110 << 20;

const MemoryOfMesh& paired_mesh(const Options& options) {
  return options.weld > 0 ? kWeldedMesh : kPairedMesh;
}

double memory_of_grid(const Options& options) {
  const double n = degree_of(options).value_or(0) + 1.0;
  return kSmallMesh + kMemoryOfCoefficient * n * n;
}

double most_of_work(const Options& options) {
  return memory_of_grid(options) + (options.no_errors ? 0 : kDistances);
}

// Returns the bytes that the pass over that number of faces takes.
double memory_of_pass(double triangles, int threads, const Options& options) {
  return memory_of_grid(options) + kOrderOfTriangle * triangles +
         kPassOfTriangle * threads * std::min(triangles, kMostOfPass);
}

// Returns the context with as many threads as fit in --max-memory beside `kept` bytes, at least
// one.
Context within_memory(double triangles, double kept, const Options& options,
                      const Session& session) {
  Context context = session.context();
  if (!options.memory.gib) return context;
  const auto limit = static_cast<double>(options.memory.limit());
  context.threads = threads_of(context);
  while (context.threads > 1 &&
         kept + memory_of_pass(triangles, context.threads, options) > limit) {
    --context.threads;
  }
  return context;
}

// Throws OutOfMemory if not even one thread fits.
void require_pass(double triangles, double kept, const Options& options) {
  const double needed = kept + memory_of_pass(triangles, 1, options);
  options.memory.require(needed, "expanding " + display_name(options.input),
                         needed + most_of_work(options));
}

Context within_memory(const MappedMesh& mesh, const Options& options, const Session& session) {
  const auto n = static_cast<double>(mesh.view().n_faces);
  require_pass(n, 0, options);
  return within_memory(n, 0, options, session);
}

// Returns true if the pass for mapped meshes may suffice: if the mesh is closed without changes.
bool may_stay(const Options& options) {
  return options.weld == 0 && parse_name<Method>(options.method) == Method::kEdge;
}
bool may_stay(double vertices, double faces, const Options& options) {
  return may_stay(options) && vertices < faces;
}

// Returns the largest number of bytes while the mesh of a file is read and expanded on one thread.
double memory_to_read_and_expand(const std::string& path, const Options& options) {
  const ShapeMemory shape = memory_to_read(path);
  const double work = may_stay(shape.vertices, shape.faces, options)
                          ? shape.kept() + memory_of_pass(shape.faces, 1, options)
                          : paired_mesh(options).of(shape) + memory_of_grid(options);
  return std::max(shape.reading, work);
}

// Throws OutOfMemory if work on a mesh in memory needs more than --max-memory. A mesh that must be
// changed, which is known later, needs more.
void check_read_mesh(const Mesh& mesh, const Options& options) {
  if (!options.memory.gib) return;
  const auto vertices = static_cast<double>(mesh.vertices.size());
  const auto faces = static_cast<double>(mesh.faces.size());
  const double paired = paired_mesh(options).of(mesh.vertices.size(), mesh.faces.size());
  note_enough_memory(paired + most_of_work(options));
  if (may_stay(vertices, faces, options)) {
    require_pass(faces, sizeof(Vec3) * vertices + sizeof(Triangle) * faces, options);
  } else {
    options.memory.require(paired + memory_of_grid(options),
                           "expanding " + display_name(options.input));
  }
}

// Throws OutOfMemory if a mesh file of that size surely needs more memory than there is. The
// estimate is twice the file, for numbers and edges.
void check_room_to_read(std::uintmax_t bytes, const std::string& path, const Options& options) {
  std::optional<std::string> refused;
  if (options.memory.gib && !is_stream(path)) {
    refused = options.memory.refusal(memory_to_read_and_expand(path, options));
  } else {
    const double needed = 2.0 * static_cast<double>(bytes);
    const auto limit = static_cast<double>(options.memory.limit());
    if (needed > limit) {
      refused = fmt::format("{:.3g} GiB or more to be read, of {:.3g} GiB", needed / 0x1p30,
                            limit / 0x1p30);
    }
  }
  if (!refused) return;
  throw Error(
      ErrorCode::kOutOfMemory,
      fmt::format("{} cannot be expanded without a copy in memory, and needs {}. Only a binary PLY "
                  "file of triangles that are closed, oriented outwards and star-shaped can be "
                  "larger than memory, with the method edge and without --weld",
                  display_name(path), *refused));
}

// Expands a stream. Input that does not fit in memory is kept in a file.
Expanded expand_stream(const Options& options, const ExpandOptions& wanted, Session& session) {
  const Stopwatch reading;
  StageTime read_in;
  const SpooledInput input(options.input, options.memory.limit() / 4, options.memory.folder());
  const auto with_time = [&](Expanded expanded) {
    expanded.times["read"] = read_in;
    return expanded;
  };
  if (const std::optional<MappedMesh> mapped = input.mesh(session.context())) {
    read_in = reading.elapsed();
    if (auto expanded = expand_mapped(*mapped, wanted, within_memory(*mapped, options, session))) {
      return with_time(std::move(*expanded));
    }
  }
  if (input.is_in_file()) check_room_to_read(input.bytes().size(), options.input, options);
  const Mesh mesh = read_mesh_of(input.bytes(), options.input, session);
  read_in = reading.elapsed();
  check_read_mesh(mesh, options);
  const double kept = static_cast<double>(sizeof(Vec3) * mesh.vertices.size() +
                                          sizeof(Triangle) * mesh.faces.size());
  const auto faces = static_cast<double>(mesh.faces.size());
  return with_time(expand(mesh, wanted, within_memory(faces, kept, options, session)));
}

// Expands an input. A mesh that needs no change is mapped, not read.
Expanded expand_input(const Options& options, const ExpandOptions& wanted, const ExpandBy& by,
                      Session& session) {
  if (options.input == "-") return expand_stream(options, wanted, session);
  Context context = session.context();
  if (options.memory.gib && !is_stream(options.input)) {
    const std::optional<MappedMesh> mapped = map_mesh(options.input, context);
    if (mapped && may_stay(options)) {
      context = within_memory(*mapped, options, session);
    } else {
      const ShapeMemory shape = memory_to_read(options.input);
      context = within_memory(shape.faces, shape.kept(), options, session);
    }
  }
  return by.expand_file(options.input, wanted, context, [&] {
    std::error_code none;
    const std::uintmax_t size = std::filesystem::file_size(options.input, none);
    if (!none) check_room_to_read(size, options.input, options);
    Mesh mesh = read_mesh(options.input, session);
    check_read_mesh(mesh, options);
    return mesh;
  });
}

// Throws NotConverged for a tolerance that is not reached; the output is already written.
void check_reached(const Options& options, const Expanded& expanded) {
  if (expanded.tolerance && !expanded.tolerance->met) {
    throw Error(ErrorCode::kNotConverged,
                fmt::format("the tolerance of {} is not reached by degree {}: the error is {}. The "
                            "file is written; try a higher --max-degree",
                            text_of(expanded.tolerance->allowed),
                            expanded.transform.expansion.coefficients.degree(),
                            text_of(expanded.tolerance->reached)));
  }
  const std::optional<FastReport>& fast = expanded.transform.fast;
  if (!fast || fast->reached) return;
  throw Error(ErrorCode::kNotConverged,
              fmt::format("the wanted precision of {} is not reached: the error is {}. The file is "
                          "written; --engine direct is slower and exact",
                          text_of(options.expand.values.precision), text_of(fast->error)));
}

constexpr std::string_view kMonteCarlo = "monte-carlo-";  // before the places of the points

int run(const Options& options, const ExpandBy& by, Session& session) {
  by.check_input(options.input);
  options.memory.keep(session);
  const bool has_degree = degree_of(options).has_value();
  if (has_degree && options.tolerance.tolerance) {
    throw UsageError("--degree and --tolerance exclude each other; give only one of the two");
  }
  if (!has_degree && !options.tolerance.tolerance) {
    throw UsageError("give --degree L or --tolerance E");
  }
  if (options.method.starts_with(kMonteCarlo)) {
    const std::string places = options.method.substr(kMonteCarlo.size());
    return expand_by_monte_carlo(options, parse_name<SamplePlaces>(places), session);
  }
  if (is_given_to_monte_carlo(options)) {
    throw UsageError(
        "--samples, --deviation and --most-samples need the method monte-carlo-edge or "
        "monte-carlo-triangle");
  }
  const ExpandOptions wanted = expand_options(options);
  const CoefficientsOutput output =
      coefficients_output(options.output, options.format, options.json);
  const Convention convention = options.convention.output_convention();
  check_writable(options.output);

  Run run;
  run.expanded = expand_input(options, wanted, by, session);
  run.diagonal = run.expanded.diagonal;
  run.expanded.transform.expansion.unit = options.length_unit;
  run.times.insert(run.expanded.times.begin(), run.expanded.times.end());
  run.times.insert(run.expanded.transform.times.begin(), run.expanded.transform.times.end());
  if (run.expanded.flipped) session.note(kFlipped);
  if (!run.expanded.star.star_shaped) {
    session.warn(
        "the surface is not star-shaped; the coefficients are those of the signed sum of its "
        "radii. The volume, area and errors of the body do not follow from them; 'rholm compress' "
        "makes a model of the body");
  }
  const Stopwatch writing;
  write_coefficients_output(run.expanded.transform.expansion, output, convention, session);
  run.times["write"] = writing.elapsed();

  if (options.json) {
    print_json(expand_json(options, run));
  } else {
    session.note(expand_text(options, run));
  }
  check_reached(options, run.expanded);
  return 0;
}

// Returns the methods of transforms, and the Monte Carlo methods.
std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const char* name : names_of(Method{}).names) names.emplace_back(name);
  for (const char* name : names_of(SamplePlaces{}).names) {
    names.push_back(std::string(kMonteCarlo) + name);
  }
  return names;
}

std::vector<Option> method_options(Options& o) {
  return {
      {.name = "method",
       .value = "METHOD",
       .help = "edge: the radius, by integrals over edges and faces; gauge: 1/radius, by integrals "
               "over edges alone; curl: the radius, by integrals over edges alone, slow; area: the "
               "radius, by cubature, for comparison; monte-carlo-edge, monte-carlo-triangle: "
               "random points, with a standard deviation for each coefficient; edge by default",
       .target = &o.method,
       .choices = method_names()},
      field_option_of(o.expand, "engine"),
      center_option(o.center),
      field_option_of(o.chart, "signed"),
      field_option_of(o.expand, "precision"),
      {.name = "no-errors",
       .help = "skip the measurement and the prediction of the errors",
       .target = &o.no_errors}};
}

// Returns the option without its default: a degree or a tolerance is required.
Option degree_option(Options& o) {
  Option option = field_option_of(o.expand, "degree");
  option.help.resize(option.help.rfind("; "));
  return option;
}

std::vector<Option> option_list(Options& o) {
  const std::string random = "with a Monte Carlo method, ";
  std::vector<Option> list = {{.name = "SHAPE",
                               .help = "file of a closed mesh, or - for standard input",
                               .target = &o.input,
                               .required = true,
                               .offer = Offer::kShapes},
                              degree_option(o)};
  append(list, tolerance_options(o.tolerance));
  append(list, method_options(o));
  append(list,
         {field_option_of(o.monte_carlo, "samples", random),
          field_option_of(o.monte_carlo, "deviation", random),
          field_option_of(o.monte_carlo, "most_samples", random),
          field_option_of(o.monte_carlo, "seed", random), field_option_of(o.chart.center, "rays"),
          weld_option(o.weld), length_unit_option(o.length_unit),
          output_option(o.output, fmt::format("file of coefficients: {}; - for standard output",
                                              coefficients_extensions())),
          format_option(o.format, coefficients_format_names())});
  append(list, memory_options(o.memory));
  append(list, convention_options(o.convention));
  list.push_back(json_option(o.json));
  return list;
}

}  // namespace

Command expand_command() {
  return expand_command_by({.expand_file =
                                [](const std::string& path, const ExpandOptions& options,
                                   const Context& context, const std::function<Mesh()>& read) {
                                  return expand_file(path, options, context, read);
                                },
                            .check_input = [](const std::string&) {}});
}

Command expand_command_by(const ExpandBy& by) {
  auto options = std::make_shared<Options>();
  return {.name = "expand",
          .summary = "Compute the coefficients of a star-shaped mesh",
          .description =
              "Expands the radius of a star-shaped closed mesh in real spherical harmonics. The "
              "integrals are over the mesh itself, without a grid and without resampling. Give "
              "--degree, or --tolerance to find the smallest degree that is accurate "
              "enough.\n\nThe error of the surface is measured and predicted, and stored in the "
              "model file. The number of quadrature nodes follows from --precision and the size of "
              "the edges. Identical vertices are joined. A mesh that is inside out is turned, with "
              "a note.\n\nA mesh that is not star-shaped is refused with exit code 3; 'rholm "
              "compress' makes a model of any shape. With --signed such a mesh is expanded "
              "nevertheless. In each direction the radii count as positive where the surface faces "
              "outwards, and as negative where it faces inwards. Their sum is the result of the "
              "integrals over the mesh, and can compare two such surfaces. Volume, area and errors "
              "of the body do not follow from it.\n\nA model file (.h5) stores everything. The "
              "headers of the other formats store what they have room for. Their numbers are 4-pi "
              "normalised without Condon-Shortley phase by default.",
          .options = in_groups(
              option_list(*options),
              {{Group::kAdvanced, {"center", "length-unit", "no-errors"}},
               {Group::kAccuracy, {"degree", "tolerance", "unit"}},
               {Group::kPaper, {"method", "samples", "deviation", "most-samples", "seed"}}}),
          .examples = {"rholm expand bumpy.ply --degree 32 -o bumpy.h5",
                       "rholm expand bumpy.ply --tolerance 1e-3 --unit diagonal --norm max -o "
                       "bumpy.h5",
                       "rholm expand bumpy.ply --degree 8 --format shtools -o -"},
          .run = [options, by](Session& session) { return run(*options, by, session); },
          .per_shape = PerShape{.extension = "h5"}};
}

}  // namespace rholm::cli
