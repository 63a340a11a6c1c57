// rholm expand with random points.
#include <fmt/format.h>

#include <string>

#include "cli/commands/expand_options.h"
#include "cli/commands/expand_report.h"
#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/prepare.h"
#include "cli/grammar/parse.h"
#include "cli/terminal/field_json.h"
#include "cli/terminal/json_text.h"
#include "rholm/error.h"
#include "rholm/star.h"

namespace rholm::cli {
namespace {

MonteCarloOptions monte_carlo_options(const ExpandCommandOptions& options, SamplePlaces places) {
  const std::optional<int> degree = degree_of(options);
  if (!degree) throw UsageError("a Monte Carlo method needs --degree L, and excludes --tolerance");
  const Given<ExpandOptions>& transform = options.expand;
  if ((transform.has("engine") && transform.values.engine == Engine::kFast) ||
      transform.has("precision")) {
    throw UsageError(
        "a Monte Carlo method is direct; it excludes --engine fast and --precision, and has "
        "--deviation");
  }
  const Given<MonteCarloOptions>& given = options.monte_carlo;
  if (given.has("samples") && (given.has("deviation") || given.has("most_samples"))) {
    throw UsageError("--samples, a fixed number, excludes --deviation and --most-samples");
  }
  MonteCarloOptions wanted = given.values;
  wanted.degree = *degree;
  wanted.places = places;
  return wanted;
}

Json json_of_run(const ExpandCommandOptions& options, const MonteCarlo& found,
                 const StarReport& star) {
  Json json = report_head(options, found.expansion);
  json.update(json_of_fields(star));
  json["places"] = found.places;
  json["samples"] = found.samples;
  json["rounds"] = found.rounds;
  json["relative_deviation"] = json_of(found.relative_deviation);
  json["deviation_reached"] = found.reached;
  json["degree_deviation"] = found.degree_deviation;
  json["norm_squared"] = json_of(found.expansion.norm_squared);
  json["truncation_rms"] = json_of(found.truncation_rms);
  json["truncation_rms_uncertainty"] = json_of(found.truncation_rms_uncertainty);
  Json wall, cpu;
  for (const auto& [stage, time] : found.times) {
    wall[stage] = time.wall;
    cpu[stage] = time.cpu;
  }
  json["seconds"] = wall;
  json["cpu_seconds"] = cpu;
  json["peak_memory_bytes"] = peak_memory_bytes();
  return json;
}

std::string text_of_deviation(const MonteCarlo& found) {
  return found.relative_deviation ? text_of(*found.relative_deviation)
                                  : "not known: too few points";
}

}  // namespace

int expand_by_monte_carlo(const ExpandCommandOptions& options, SamplePlaces places,
                          Session& session) {
  const MonteCarloOptions wanted = monte_carlo_options(options, places);
  const CoefficientsOutput output =
      coefficients_output(options.output, options.format, options.json);
  const Convention convention = options.convention.output_convention();
  check_writable(options.output);

  const Prepared prepared = prepare(read_mesh(options.input, session), options.weld);
  if (prepared.flipped) session.note(kFlipped);
  const StarChart chart = make_star_chart(
      prepared.mesh, chart_options(options.chart, options.center), session.context());
  MonteCarlo found = monte_carlo(chart, wanted, session.context());
  found.expansion.unit = options.length_unit;
  write_coefficients_output(found.expansion, output, convention, session);

  if (options.json) {
    print_json(json_of_run(options, found, chart.report));
  } else {
    session.note(
        fmt::format("{}: degree {} by {}, {} points on each of {} {}; relative deviation {}",
                    options.output, wanted.degree, options.method, found.samples, found.places,
                    places == SamplePlaces::kEdges ? "edges" : "faces", text_of_deviation(found)));
  }
  if (!found.reached) {
    throw Error(ErrorCode::kNotConverged,
                fmt::format("the wanted deviation is not reached with {} points each: it is {}. "
                            "The file is written; try a larger --most-samples",
                            found.samples, text_of_deviation(found)));
  }
  return 0;
}

}  // namespace rholm::cli
