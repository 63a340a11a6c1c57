// Options of rholm expand. Layer: cli.
#pragma once

#include <optional>
#include <string>

#include "cli/options/convention.h"
#include "cli/options/field_options.h"
#include "cli/options/memory_options.h"
#include "cli/options/tolerance_options.h"
#include "cli/terminal/session.h"
#include "rholm/model.h"
#include "rholm/monte_carlo.h"

namespace rholm::cli {

struct ExpandCommandOptions {
  std::string input;
  Given<ExpandOptions> expand;  // without the method
  std::string method = "edge";  // a method, or "monte-carlo-" with the places of points
  ToleranceOptions tolerance;
  ChartOptions chart;  // without the centre
  std::string center = "auto";
  bool no_errors = false;
  double weld = 0;
  Given<MonteCarloOptions> monte_carlo;
  std::string length_unit;
  MemoryOptions memory;
  std::string output;
  std::string format;
  ConventionOptions convention;
  bool json = false;
};

// Returns the degree, if given.
inline std::optional<int> degree_of(const ExpandCommandOptions& options) {
  if (!options.expand.has("degree")) return std::nullopt;
  return options.expand.values.degree;
}

// Returns true if an option only of Monte Carlo methods was given; a seed is ignored.
inline bool is_given_to_monte_carlo(const ExpandCommandOptions& options) {
  const Given<MonteCarloOptions>& given = options.monte_carlo;
  return given.has("samples") || given.has("deviation") || given.has("most_samples");
}

// Runs the whole command for Monte Carlo methods; returns the exit code.
int expand_by_monte_carlo(const ExpandCommandOptions& options, SamplePlaces places,
                          Session& session);

}  // namespace rholm::cli
