// Options of rholm analyze. Layer: cli.
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
  Given<AnalyzeOptions> analyze;  // without the method
  std::string method = "edge";    // a method, or "monte-carlo-" with the places of points
  ToleranceOptions tolerance;
  ChartOptions chart;  // without the centre
  std::string center = "auto";
  bool no_errors = false;
  double weld = 0;
  Given<MonteCarloOptions> monte_carlo;  // its seed is also used for an atlas
  bool atlas = false;
  std::string fit;  // method for an atlas; empty: least-squares
  Given<CompressOptions> caps;
  Given<PatchAtlasOptions> patches;
  std::string length_unit;
  std::string columns;  // meaning of columns of points; empty: from the file
  MemoryOptions memory;
  std::string output;
  std::string format;
  ConventionOptions convention;
  bool json = false;
};

// Returns the degree, if given.
inline std::optional<int> degree_of(const AnalyzeCommandOptions& options) {
  if (!options.analyze.has("degree")) return std::nullopt;
  return options.analyze.values.degree;
}

// Returns true if an option only of Monte Carlo methods was given; a seed is ignored.
inline bool is_given_to_monte_carlo(const AnalyzeCommandOptions& options) {
  const Given<MonteCarloOptions>& given = options.monte_carlo;
  return given.has("samples") || given.has("deviation") || given.has("most_samples");
}

// Runs the whole command for Monte Carlo methods; returns the exit code.
int analyze_by_monte_carlo(const AnalyzeCommandOptions& options, SamplePlaces places,
                           Session& session);

}  // namespace rholm::cli
