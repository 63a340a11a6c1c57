#include "cli/commands/expand_report.h"

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

Json times_json(const ExpandRun& run, double StageTime::*clock) {
  Json json;
  for (const char* stage : {"read", "topology", "center", "transform", "order", "faces", "spread",
                            "fourier", "verify", "norms", "rays", "errors", "write"}) {
    const auto found = run.times.find(stage);
    json[stage] = found == run.times.end() ? 0.0 : found->second.*clock;
  }
  return json;
}

Json relative(double length, double diagonal) {
  return diagonal > 0 ? Json(length / diagonal) : Json(nullptr);
}

// Returns the number of points on the sphere in the sums.
std::size_t sources_of(const Transform& transform) {
  return transform.fast ? transform.fast->vertices + transform.fast->nodes
                        : transform.edge_nodes + transform.face_nodes;
}

Json tolerance_json(const ExpandCommandOptions& options, const ToleranceReport& report) {
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

Json report_head(const ExpandCommandOptions& options, const Expansion& expansion) {
  return {{"file", options.input},
          {"output", options.output},
          {"degree", expansion.coefficients.degree()},
          {"method", expansion.method},
          {"function", to_string(expansion.function)}};
}

Json expand_json(const ExpandCommandOptions& options, const ExpandRun& run) {
  const Expanded& expanded = run.expanded;
  const Transform& transform = expanded.transform;
  Json json = report_head(options, transform.expansion);
  json["precision"] = options.expand.values.precision;
  json.update(json_of_fields(expanded.star));
  json["signed"] = options.chart.allow_signed;
  json["signed_sum"] = transform.expansion.signed_sum;
  json["counts"] = {{"vertices", expanded.vertices},
                    {"faces", expanded.faces},
                    {"edges", expanded.edges},
                    {"nodes", sources_of(transform)}};
  json["engine"] = transform.fast || options.expand.has("engine")
                       ? to_string(options.expand.values.engine)
                       : "direct";
  if (transform.fast) {
    json["fast"] = json_of(*transform.fast);
  } else {
    json["edge_nodes"] = transform.edge_nodes;
    json["face_nodes"] = transform.face_nodes;
  }
  json["merged_vertices"] = expanded.merged_vertices;
  json["collapsed_faces"] = expanded.collapsed_faces;
  json["flipped"] = expanded.flipped;
  json["closure_residual"] = json_of(transform.closure_residual);
  json["norm_squared"] = json_of(transform.expansion.norm_squared);
  json["tail_strength"] = json_of(transform.expansion.tail_strength);
  json["truncation_rms"] = json_of(transform.truncation_rms);
  json["truncation_rms_uncertainty"] = json_of(transform.truncation_rms_uncertainty);
  // The difference of the exact norm and the norm of the coefficients, with its uncertainty.
  json["kinds"] = {{"truncation_rms", "exact"}, {"truncation_rms_uncertainty", "bound"}};
  json["errors"] = json_of(transform.expansion.errors);
  json["tolerance"] =
      expanded.tolerance ? tolerance_json(options, *expanded.tolerance) : Json(nullptr);
  json["diagonal"] = run.diagonal;
  json["relative"] = {{"min_d", relative(expanded.star.min_d, run.diagonal)}};
  if (transform.truncation_rms && transform.expansion.function == RadialFunction::kRadius) {
    json["relative"]["truncation_rms"] = relative(*transform.truncation_rms, run.diagonal);
  }
  json["seconds"] = times_json(run, &StageTime::wall);
  json["cpu_seconds"] = times_json(run, &StageTime::cpu);
  json["peak_memory_bytes"] = peak_memory_bytes();
  return json;
}

std::string expand_text(const ExpandCommandOptions& options, const ExpandRun& run) {
  const Expanded& expanded = run.expanded;
  const Transform& transform = expanded.transform;
  double seconds = 0;
  for (const char* stage : {"read", "topology", "center", "transform", "norms", "rays", "write"}) {
    const auto found = run.times.find(stage);
    if (found != run.times.end()) seconds += found->second.wall;
  }
  std::string text =
      fmt::format("{}: degree {} by {}, {} vertices, {} faces, {} nodes in {:.2f} s",
                  options.output, transform.expansion.coefficients.degree(), options.method,
                  expanded.vertices, expanded.faces, sources_of(transform), seconds);
  text += fmt::format("; centre {}, min d {}", text_of(expanded.star.center),
                      text_of(expanded.star.min_d));
  const std::optional<TruncationErrors>& errors = transform.expansion.errors;
  if (errors && errors->rms && errors->measured_max) {
    text +=
        fmt::format("; error of the radius {} rms ({}), {} at most", text_of(*errors->rms),
                    errors->rms_is_exact ? "exact" : "measured", text_of(*errors->measured_max));
  } else if (transform.truncation_rms) {
    text += fmt::format("; the degrees beyond hold {} rms", text_of(*transform.truncation_rms));
  } else {
    text += "; error of the radius not known";
  }
  return text;
}

}  // namespace rholm::cli
