#include "cli/commands/analyze_report.h"

#include <sys/resource.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/terminal/field_json.h"

namespace rholm::cli {

std::uint64_t peak_memory_bytes() {
  rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

namespace {

Json times_json(const AnalyzeRun& run, double StageTime::*clock) {
  Json json;
  for (const char* stage : {"read", "topology", "center", "transform", "order", "triangles",
                            "spread", "fourier", "verify", "norms", "rays", "errors", "write"}) {
    const auto found = run.times.find(stage);
    json[stage] = found == run.times.end() ? 0.0 : found->second.*clock;
  }
  return json;
}

Json relative(double length, double diagonal) {
  return diagonal > 0 ? Json(length / diagonal) : Json(nullptr);
}

// Returns the number of points on the sphere in the sums.
std::size_t sources_of(const Analysis& analysis) {
  return analysis.fast ? analysis.fast->vertices + analysis.fast->nodes
                       : analysis.edge_nodes + analysis.face_nodes;
}

Json tolerance_json(const AnalyzeCommandOptions& options, const ToleranceReport& report) {
  const Tolerance tolerance = *options.tolerance.parsed();
  return {{"wanted", tolerance.error},
          {"norm", to_string(tolerance.norm)},
          {"measure", to_string(tolerance.measure)},
          {"unit", to_string(tolerance.unit)},
          {"allowed", report.allowed},
          {"reached", report.reached},
          {"met", report.met},
          {"degrees_computed", report.degrees}};
}

}  // namespace

Json analyze_json(const AnalyzeCommandOptions& options, const AnalyzeRun& run) {
  const Encoded& encoded = run.encoded;
  const Analysis& analysis = encoded.analysis;
  Json json;
  json["file"] = options.input;
  json["output"] = options.output;
  json["degree"] = analysis.expansion.coefficients.degree();
  json["method"] = analysis.expansion.method;
  json["function"] = to_string(analysis.expansion.function);
  json["precision"] = options.analyze.values.precision;
  json.update(json_of_fields(encoded.star));
  json["signed"] = options.chart.allow_signed;
  json["signed_sum"] = analysis.expansion.signed_sum;
  json["counts"] = {{"vertices", encoded.vertices},
                    {"faces", encoded.faces},
                    {"edges", encoded.edges},
                    {"nodes", sources_of(analysis)}};
  json["engine"] = analysis.fast || options.analyze.has("engine")
                       ? to_string(options.analyze.values.engine)
                       : "direct";
  if (analysis.fast) {
    json["fast"] = json_of(*analysis.fast);
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
  json["truncation_rms_doubt"] = json_of(analysis.truncation_rms_doubt);
  // The difference of the exact norm and the norm of the coefficients, with its uncertainty.
  json["kinds"] = {{"truncation_rms", "exact"}, {"truncation_rms_doubt", "bound"}};
  json["errors"] = json_of(analysis.expansion.errors);
  json["tolerance"] =
      encoded.tolerance ? tolerance_json(options, *encoded.tolerance) : Json(nullptr);
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

std::string analyze_text(const AnalyzeCommandOptions& options, const AnalyzeRun& run) {
  const Encoded& encoded = run.encoded;
  const Analysis& analysis = encoded.analysis;
  double seconds = 0;
  for (const char* stage : {"read", "topology", "center", "transform", "norms", "rays", "write"}) {
    const auto found = run.times.find(stage);
    if (found != run.times.end()) seconds += found->second.wall;
  }
  std::string text =
      fmt::format("{}: degree {} by {}, {} vertices, {} faces, {} nodes in {:.2f} s",
                  options.output, analysis.expansion.coefficients.degree(), options.method,
                  encoded.vertices, encoded.faces, sources_of(analysis), seconds);
  text += fmt::format("; centre {}, min d {}", text_of(encoded.star.center),
                      text_of(encoded.star.min_d));
  const std::optional<TruncationErrors>& errors = analysis.expansion.errors;
  if (errors && errors->rms && errors->measured_max) {
    text +=
        fmt::format("; error of the radius {} rms ({}), {} at most", text_of(*errors->rms),
                    errors->rms_is_exact ? "exact" : "measured", text_of(*errors->measured_max));
  } else if (analysis.truncation_rms) {
    text += fmt::format("; the degrees beyond hold {} rms", text_of(*analysis.truncation_rms));
  } else {
    text += "; error of the radius not known";
  }
  return text;
}

}  // namespace rholm::cli
