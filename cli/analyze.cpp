// rholm analyze: from a mesh to its coefficients.
#include <sys/resource.h>

#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "cli/command.h"
#include "cli/convention.h"
#include "cli/inputs.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"
#include "cli/parse.h"
#include "cli/prepare.h"
#include "cli/program.h"
#include "cli/report.h"
#include "cli/session.h"
#include "rholm/error.h"
#include "rholm/model.h"

namespace rholm::cli {
namespace {

struct Options {
  std::string input;
  int degree = 0;
  std::string method = "edge";
  std::string engine = "fast";
  std::string center = "auto";
  bool allow_signed = false;
  double precision = AnalyzeOptions{}.precision;
  int rays = 100'000;
  double weld = 0;
  std::string unit;
  std::string output;
  std::string format;
  ConventionOptions convention;
  bool json = false;
};

// A run: what was found, and how long it took.
struct Run {
  Encoded encoded;
  double diagonal = 0;
  StageTimes times;
};

std::uint64_t peak_memory_bytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

EncodeOptions encode_options(const Options& options) {
  EncodeOptions wanted;
  wanted.analyze = {.degree = options.degree,
                    .method = parse_method(options.method),
                    .engine = parse_engine(options.engine),
                    .precision = options.precision};
  wanted.chart.center = parse_center_option(options.center);
  wanted.chart.center.rays = options.rays;
  wanted.chart.allow_signed = options.allow_signed;
  wanted.weld_tolerance = options.weld;
  return wanted;
}

Json times_json(const Run& run, double StageTime::*clock) {
  Json json;
  for (const char* stage : {"read", "topology", "center", "transform", "triangles", "spread",
                            "fourier", "norms", "write"}) {
    const auto found = run.times.find(stage);
    json[stage] = found == run.times.end() ? 0.0 : found->second.*clock;
  }
  return json;
}

Json relative(double length, double diagonal) {
  return diagonal > 0 ? Json(length / diagonal) : Json(nullptr);
}

// Points of the sphere that are summed over.
std::size_t sources_of(const Analysis& analysis) {
  return analysis.fast ? analysis.fast->vertices + analysis.fast->nodes
                       : analysis.edge_nodes + analysis.face_nodes;
}

Json fast_json(const FastReport& fast) {
  return {{"precision", fast.single ? "single" : "double"},
          {"window_width", fast.width},
          {"oversampling", fast.oversampling},
          {"lumped_faces", fast.lumped_triangles},
          {"vertices", fast.vertices},
          {"nodes", fast.nodes},
          {"passes", fast.passes},
          {"precision_reached", fast.reached},
          {"estimated_error", fast.error},
          {"estimated_error_of_top_quarter", fast.band_error}};
}

Json report_json(const Options& options, const Run& run) {
  const Encoded& encoded = run.encoded;
  const Analysis& analysis = encoded.analysis;
  Json json;
  json["file"] = options.input;
  json["output"] = options.output;
  json["degree"] = analysis.expansion.coefficients.degree();
  json["method"] = analysis.expansion.method;
  json["function"] = to_string(analysis.expansion.function);
  json["precision"] = options.precision;
  add_star_report(encoded.star, json);
  json["signed"] = options.allow_signed;
  json["counts"] = {{"vertices", encoded.vertices},
                    {"faces", encoded.faces},
                    {"edges", encoded.edges},
                    {"nodes", sources_of(analysis)}};
  json["engine"] = analysis.fast ? "fast" : options.engine;
  if (analysis.fast) {
    json["fast"] = fast_json(*analysis.fast);
  } else {
    json["edge_nodes"] = analysis.edge_nodes;
    json["face_nodes"] = analysis.face_nodes;
  }
  json["merged_vertices"] = encoded.merged_vertices;
  json["collapsed_faces"] = encoded.collapsed_triangles;
  json["flipped"] = encoded.flipped;
  json["closure_residual"] = json_of(analysis.closure_residual);
  json["norm_squared"] = json_of(analysis.expansion.norm_squared);
  json["tail_strength"] = json_of(analysis.expansion.tail_strength);
  json["truncation_rms"] = json_of(analysis.truncation_rms);
  json["diagonal"] = run.diagonal;
  json["relative"] = {{"min_d", relative(encoded.star.min_d, run.diagonal)}};
  if (analysis.truncation_rms && analysis.expansion.function == RadialFunction::kRadius) {
    json["relative"]["truncation_rms"] = relative(*analysis.truncation_rms, run.diagonal);
  }
  json["seconds"] = times_json(run, &StageTime::wall);
  json["cpu_seconds"] = times_json(run, &StageTime::cpu);
  json["peak_memory_bytes"] = peak_memory_bytes();
  return json;
}

std::string report_text(const Options& options, const Run& run) {
  const Encoded& encoded = run.encoded;
  const Analysis& analysis = encoded.analysis;
  double seconds = 0;
  for (const char* stage : {"read", "topology", "center", "transform", "norms", "write"}) {
    const auto found = run.times.find(stage);
    if (found != run.times.end()) seconds += found->second.wall;
  }
  std::string text = fmt::format("{}: degree {} by {}, {} vertices, {} faces, {} nodes in {:.2f} s",
                                 options.output, options.degree, options.method, encoded.vertices,
                                 encoded.faces, sources_of(analysis), seconds);
  text += fmt::format("; centre {}, min d {}", text_of(encoded.star.center),
                      text_of(encoded.star.min_d));
  if (analysis.truncation_rms) {
    text += fmt::format("; the degrees beyond hold {} rms", text_of(*analysis.truncation_rms));
  }
  return text;
}

// A mesh that can stay where it lies in its file is not read.
Encoded encode_input(const std::string& path, const EncodeOptions& wanted, Session& session,
                     StageTimes& times) {
  const Stopwatch reading;
  if (path != "-") {
    const std::optional<MappedMesh> mapped = map_mesh(path, session.context());
    times["read"] = reading.elapsed();
    if (mapped) {
      if (auto encoded = encode_mapped(*mapped, wanted, session.context())) {
        return std::move(*encoded);
      }
    }
  }
  const Mesh mesh = read_mesh(path, session);
  times["read"] = reading.elapsed();
  return encode(mesh, wanted, session.context());
}

int run(const Options& options, Session& session) {
  const EncodeOptions wanted = encode_options(options);
  const CoefficientsOutput output =
      coefficients_output(options.output, options.format, options.json);
  const Convention convention = options.convention.output_convention();
  check_writable(options.output);

  Run run;
  run.encoded = encode_input(options.input, wanted, session, run.times);
  run.diagonal = run.encoded.diagonal;
  run.encoded.analysis.expansion.unit = options.unit;
  run.times.insert(run.encoded.times.begin(), run.encoded.times.end());
  run.times.insert(run.encoded.analysis.times.begin(), run.encoded.analysis.times.end());
  if (run.encoded.flipped) session.note(kFlipped);
  if (!run.encoded.star.star_shaped) {
    session.warn(
        "the surface is not star-shaped: the coefficients are those of the alternating "
        "sum of its radii");
  }
  const Stopwatch writing;
  write_coefficients_output(run.encoded.analysis.expansion, output, convention);
  run.times["write"] = writing.elapsed();

  if (options.json) {
    print_json(report_json(options, run));
  } else {
    session.note(report_text(options, run));
  }
  const std::optional<FastReport>& fast = run.encoded.analysis.fast;
  if (!fast || fast->reached) return 0;
  session.warn(
      fmt::format("the wanted precision of {} was not reached: the estimated error is {}; "
                  "--engine direct is slower and exact",
                  text_of(options.precision), text_of(fast->error)));
  return kNotConverged;
}

std::vector<Option> option_list(Options& o) {
  return {{.name = "SHAPE",
           .help = "file of a closed mesh, or - for standard input",
           .target = &o.input,
           .required = true,
           .offer = Offer::kShapes},
          {.name = "degree",
           .value = "L",
           .help = "the highest degree; there are (L+1)^2 coefficients",
           .target = &o.degree,
           .required = true,
           .min = 0,
           .max = kMaxDegree},
          {.name = "method",
           .help = "edge (the default): the radius, over edges and faces; gauge: 1/radius, over "
                   "edges alone; curl: the radius over edges alone, slow; area: the radius by "
                   "plain cubature, for comparison",
           .target = &o.method,
           .choices = {"edge", "gauge", "curl", "area"}},
          {.name = "engine",
           .help = "fast (the default): sums on an oversampled grid, as exact as --precision says; "
                   "direct: term by term, slow; curl and area are always direct",
           .target = &o.engine,
           .choices = {"fast", "direct"}},
          center_option(o.center),
          {.name = "signed",
           .help = "accept a surface that is not star-shaped: the alternating sum of its radii",
           .target = &o.allow_signed},
          {.name = "precision",
           .value = "P",
           .help = "wanted relative error of the coefficients, 1e-14 ... 1e-1; 1e-8 by default",
           .target = &o.precision,
           .min = 1e-14,
           .max = 1e-1},
          rays_option(o.rays),
          weld_option(o.weld),
          {.name = "unit",
           .value = "NAME",
           .help = "unit of length to write into the file, as in km",
           .target = &o.unit},
          output_option(o.output,
                        "file of coefficients: .h5 (model file), .sh (SHTOOLS text), "
                        ".gfc, .json, .npy; - for standard output"),
          format_option(o.format, coefficients_formats()),
          normalization_option(o.convention.normalization, ""),
          csphase_option(o.convention.csphase, ""),
          json_option(o.json)};
}

}  // namespace

Command analyze_command() {
  auto options = std::make_shared<Options>();
  return {.name = "analyze",
          .summary = "From a mesh to its coefficients",
          .description =
              "Expands the radius of a star-shaped mesh (or 1/radius, with --method gauge) in "
              "real spherical harmonics. The mesh is the surface, exactly: no grid, no "
              "resampling; the number of quadrature nodes follows from --precision and the size "
              "of the edges.\n\nIdentical vertices are joined, a mesh that is inside out is "
              "turned, and said. A mesh that is not star-shaped is refused with exit code 3, "
              "unless --signed is given.\n\nThe model file keeps all there is to know; of the "
              "other formats the header says what it can, and the numbers are 4-pi normalised "
              "without Condon-Shortley phase unless told otherwise.",
          .options = option_list(*options),
          .examples = {"rholm analyze bumpy.ply --degree 32 -o bumpy.h5",
                       "rholm analyze bumpy.ply --degree 8 --format shtools -o -"},
          .run = [options](Session& session) { return run(*options, session); }};
}

}  // namespace rholm::cli
