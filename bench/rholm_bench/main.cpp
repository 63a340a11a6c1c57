// rholm_bench measures the speed of rholm on this machine. It uses the best instruction set, or the
// set that RHOLM_TEST_TARGET names.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/files/inputs.h"
#include "cli/grammar/parse.h"
#include "cli/grammar/values.h"
#include "cli/program.h"
#include "cli/terminal/bus_error.h"
#include "cli/terminal/descriptors.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/freed_memory.h"
#include "cli/terminal/interrupt.h"
#include "cli/terminal/program_name.h"
#include "cli/terminal/session.h"
#include "rholm/error.h"
#include "rholm/version.h"
#include "rholm_bench/bench_mesh.h"
#include "rholm_bench/bench_report.h"
#include "support/targets.h"

namespace rholm::cli {
namespace {

struct Options {
  std::vector<std::string> shapes;
  std::string faces;
  std::string degree = "256";
  std::string precision = "1e-6";
  std::string thread_counts = "1";
  int repeat = 5;
  bool shuffle = false;
  bool allow_signed = false;
  bool json = false;
};

constexpr const char* kFaces = "82000,1300000";  // chosen: in cache, and beyond it; seconds
constexpr double kMostFaces = 2e8;               // a cube of squares can number these

// Parses a list of numbers within bounds, both inclusive.
std::vector<double> parse_list(const std::string& option, const std::string& text, double low,
                               double high) {
  std::vector<double> list;
  for (const std::string& part : split(text, ',')) {
    const std::optional<double> number = read_number(part);
    if (!number || !(*number >= low && *number <= high)) {
      throw UsageError(
          fmt::format("{} is '{}' and has '{}'; it must be numbers within {:g} ... {:g} "
                      "between commas",
                      option, text, part, low, high));
    }
    list.push_back(*number);
  }
  return list;
}

std::vector<int> parse_counts(const std::string& option, const std::string& text, int low,
                              double high) {
  std::vector<int> counts;
  for (const double number : parse_list(option, text, low, high)) {
    counts.push_back(static_cast<int>(number));
  }
  return counts;
}

std::vector<double> parse_precisions(const std::string& option, const std::string& text) {
  return parse_list(option, text, 1e-14, 1e-1);
}

std::vector<int> parse_threads(const std::string& option, const std::string& text) {
  return parse_counts(option, text, 1, 4096);
}

std::vector<int> parse_faces(const std::string& option, const std::string& text) {
  return parse_counts(option, text, 12, kMostFaces);
}

// A mesh to measure, in memory, and the file that is processed.
struct Subject {
  std::string name;
  Mesh mesh;
  std::string path;                       // file of the user, or of `made`
  std::unique_ptr<TemporaryMesh> made{};  // file of a made mesh
  std::filesystem::path file() const { return made ? made->path() : std::filesystem::path(path); }
};

struct Settings {
  std::vector<int> degrees;
  std::vector<double> precisions;
  BenchOptions bench;
  bool shuffle = false;
};

std::filesystem::path temporary_folder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (error) {
    throw Error(ErrorCode::kIo, fmt::format("there is no folder for temporary files: {}; TMPDIR "
                                            "names another one",
                                            error.message()));
  }
  return folder;
}

Settings settings_of(const Options& options) {
  Settings settings;
  settings.degrees = parse_degrees("--degree", options.degree);
  settings.precisions = parse_precisions("--precision", options.precision);
  settings.shuffle = options.shuffle;
  settings.bench = {.allow_signed = options.allow_signed,
                    .repeat = options.repeat,
                    .threads = parse_threads("--thread-counts", options.thread_counts),
                    .folder = temporary_folder()};
  return settings;
}

// Data that all measurements share.
struct Work {
  const Settings& settings;
  Session& session;
  std::optional<CoefficientsError> fast_reference = {};  // error of a fast reference, once used
};

BenchOptions options_of(const Settings& settings, int degree, double precision) {
  BenchOptions options = settings.bench;
  options.degree = degree;
  options.precision = precision;
  return options;
}

std::string reference_name(const Reference& reference, Work& work) {
  if (reference.engine == Engine::kDirect) {
    return fmt::format("direct sums at precision {:g}", reference.precision);
  }
  if (!work.fast_reference) {
    work.fast_reference = bench_reference_error(work.session.context());
  }
  return fmt::format(
      "fast sums at precision {:g} (those against direct ones, on a small mesh: {:.1g})",
      reference.precision, work.fast_reference->error);
}

void compare(const Reference& reference, Work& work, BenchCase& run) {
  run.error = compare_coefficients(run.file.expanded.transform.expansion.coefficients,
                                   reference.coefficients);
  run.reference = reference_name(reference, work);
}

BenchCase measure_case(const Work& work, const Subject& subject, int degree, double precision) {
  const BenchOptions options = options_of(work.settings, degree, precision);
  const Context& context = work.session.context();
  BenchCase run;
  run.mesh = subject.name;
  run.degree = degree;
  run.precision = precision;
  run.file = bench_file(subject.file(), options, context);
  const Transform& transform = run.file.expanded.transform;
  run.sums = bench_sums(subject.mesh, transform.expansion, options, context);
  if (transform.fast) {
    run.floors = bench_floors(subject.file(), subject.mesh, transform.expansion, *transform.fast,
                              options, context);
  }
  return run;
}

BenchCase measure_shuffled(const Work& work, const Subject& subject, const BenchCase& ordered) {
  Mesh mesh = subject.mesh;
  shuffle(mesh);
  const TemporaryMesh file(mesh, work.settings.bench.folder);
  BenchCase run;
  run.mesh = subject.name;
  run.random_order = true;
  run.degree = ordered.degree;
  run.precision = ordered.precision;
  run.file = bench_file(file.path(), options_of(work.settings, run.degree, run.precision),
                        work.session.context());
  const auto cpu = [](const BenchCase& of) {
    return of.file.runs[0].stages.at("coefficients").median.cpu;
  };
  run.slowdown = cpu(run) / cpu(ordered);
  return run;
}

// Measures every degree and precision.
void measure(const Subject& subject, Work& work, std::vector<BenchCase>& cases) {
  const Settings& settings = work.settings;
  const double least = *std::min_element(settings.precisions.begin(), settings.precisions.end());
  for (const int degree : settings.degrees) {
    std::optional<Reference> reference;
    for (const double precision : settings.precisions) {
      BenchCase run = measure_case(work, subject, degree, precision);
      if (!reference) {
        const Vec3 center = run.file.expanded.transform.expansion.center;
        reference = bench_reference(subject.file(), center, options_of(settings, degree, least),
                                    work.session.context());
      }
      compare(*reference, work, run);
      cases.push_back(std::move(run));
      if (!settings.shuffle) continue;
      BenchCase shuffled = measure_shuffled(work, subject, cases.back());
      compare(*reference, work, shuffled);
      cases.push_back(std::move(shuffled));
    }
  }
}

Subject own_subject(int faces, const Settings& settings) {
  Subject subject{.name = "smooth body", .mesh = smooth_mesh(faces), .path = {}};
  stop_if_interrupted();
  subject.made = std::make_unique<TemporaryMesh>(subject.mesh, settings.bench.folder);
  return subject;
}

int run(const Options& options, Session& session) {
  const Settings settings = settings_of(options);
  const std::string faces =
      options.faces.empty() && options.shapes.empty() ? kFaces : options.faces;
  const std::vector<int> own = faces.empty() ? std::vector<int>{} : parse_faces("--faces", faces);
  if (std::find(options.shapes.begin(), options.shapes.end(), "-") != options.shapes.end()) {
    throw UsageError("standard input can be read once only: a mesh to measure needs a name");
  }
  Work work{settings, session};
  std::vector<BenchCase> cases;
  for (const int n : own) measure(own_subject(n, settings), work, cases);
  for (const std::string& shape : options.shapes) {
    measure({.name = shape, .mesh = read_mesh(shape, session), .path = shape}, work, cases);
  }
  stop_if_interrupted();
  if (options.json) {
    Json json = {{"version", kVersion}, {"machine", machine_json()}, {"repeat", options.repeat}};
    if (work.fast_reference) json["fast_reference"] = json_of(*work.fast_reference);
    for (const BenchCase& one : cases) json["cases"].push_back(case_json(one));
    print_json(json);
  } else {
    print_text(machine_text());
    for (const BenchCase& one : cases) print_text(case_text(one));
  }
  return 0;
}

std::vector<Option> option_list(Options& o) {
  return {{.name = "SHAPE",
           .help = "files of closed meshes; without any the program makes its own",
           .target = &o.shapes,
           .offer = Offer::kShapes},
          {.name = "faces",
           .value = "N,...",
           .help = "make smooth bodies with about so many triangles; 82000,1300000 if no file is "
                   "given",
           .target = &o.faces,
           .check = parse_faces},
          {.name = "degree",
           .value = "L,...",
           .help = "the highest degree; 256 by default",
           .target = &o.degree,
           .check = parse_degrees},
          {.name = "precision",
           .value = "P,...",
           .help = "wanted relative errors of the coefficients; 1e-6 by default",
           .target = &o.precision,
           .check = parse_precisions},
          {.name = "repeat",
           .value = "N",
           .help = "runs of each kind; 5 by default, reported are median and least",
           .target = &o.repeat,
           .min = 1,
           .max = 1000},
          {.name = "thread-counts",
           .value = "N,...",
           .help = "numbers of threads that take turns from file to coefficients, the first to "
                   "compare with; 1 by default",
           .target = &o.thread_counts,
           .check = parse_threads},
          {.name = "shuffle",
           .help = "measure copies with the triangles in random order, too",
           .target = &o.shuffle},
          {.name = "signed",
           .help = "accept a surface that is not star-shaped: the signed sum of its radii",
           .target = &o.allow_signed},
          json_option(o.json)};
}

Command bench_command() {
  auto options = std::make_shared<Options>();
  return {.name = "",
          .summary = "How fast it is on this machine, stage by stage",
          .description =
              "Measures the way from the bytes of a mesh to its coefficients: processor and wall "
              "time of each stage, median and least of several runs, per triangle and per source "
              "of the sums; the error that was reached; memory. Beside them, in the same run, what "
              "bounds the stages: reading and copying as many bytes, the bare updates of the grid, "
              "the Legendre sums alone, and sums done term by term, from a sample.\n\n"
              "Everything is on one thread but the runs of --thread-counts and what is not "
              "measured. Meshes that the program makes are files without a name in the folder for "
              "temporary files (TMPDIR).",
          .options = option_list(*options),
          .examples = {"rholm_bench --faces 5000 --degree 32 --repeat 3",
                       "rholm_bench bumpy.ply --degree 32 --precision 1e-4,1e-6 --json"},
          .run = [options](Session& session) { return run(*options, session); },
          .if_not_star = "Give --signed to measure it nevertheless"};
}

}  // namespace
}  // namespace rholm::cli

int main(int argc, char** argv) {
  using namespace rholm::cli;
  fill_standard_descriptors();
  set_program_name("rholm_bench");
  if (const std::string wrong = rholm::test::force_target_of_environment(); !wrong.empty()) {
    print_error(wrong);
    return kUsage;
  }
  keep_freed_memory();
  start_on_huge_pages();
  install_signal_handlers();
  install_bus_error_handler();
  const Outcome outcome = run_program(bench_command(), {argv + 1, argv + argc});
  if (!outcome.message.empty()) print_error(outcome.message);
  return outcome.code;
}
