// What the command line of rholm analyze says. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/options/convention.h"
#include "cli/options/field_options.h"
#include "cli/options/memory_options.h"
#include "cli/options/tolerance_options.h"
#include "cli/terminal/session.h"
#include "rholm/compress.h"
#include "rholm/model.h"
#include "rholm/monte_carlo.h"
#include "rholm/patch_atlas.h"

namespace rholm::cli {

struct AnalyzeCommandOptions {
  std::string input;
  Given<AnalyzeOptions> analyze;  // but the method
  std::string method = "edge";    // of AnalyzeOptions, or "monte-carlo-" and places of the points
  ToleranceOptions tolerance;
  ChartOptions chart;  // but the centre
  std::string center = "auto";
  bool no_errors = false;
  double weld = 0;
  Given<MonteCarloOptions> monte_carlo;  // the seed is that of an atlas, too
  bool atlas = false;
  std::string fit;  // of an atlas; empty: least-squares
  Given<CompressOptions> caps;
  Given<PatchAtlasOptions> patches;
  std::string length_unit;
  std::string columns;  // of points; empty: what the file says
  MemoryOptions memory;
  std::string output;
  std::string format;
  ConventionOptions convention;
  bool json = false;
};

// The degree that was given.
inline std::optional<int> degree_of(const AnalyzeCommandOptions& options) {
  if (!options.analyze.has("degree")) return std::nullopt;
  return options.analyze.values.degree;
}

// Whether an option was given that other methods have not; a seed does no harm.
inline bool is_given_to_monte_carlo(const AnalyzeCommandOptions& options) {
  const Given<MonteCarloOptions>& given = options.monte_carlo;
  return given.has("samples") || given.has("deviation") || given.has("most_samples");
}

// The whole command for the Monte Carlo methods; returns the exit code.
int analyze_by_monte_carlo(const AnalyzeCommandOptions& options, SamplePlaces places,
                           Session& session);

}  // namespace rholm::cli
