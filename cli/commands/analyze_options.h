// What the command line of rholm analyze says. Layer: cli.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "cli/options/convention.h"
#include "cli/options/memory_options.h"
#include "cli/options/tolerance_options.h"
#include "cli/terminal/session.h"
#include "rholm/model.h"
#include "rholm/monte_carlo.h"

namespace rholm::cli {

struct AnalyzeCommandOptions {
  std::string input;
  std::optional<int> degree;
  ToleranceOptions tolerance;
  bool atlas = false;
  std::string fit;                 // of an atlas; empty: least-squares
  std::string extension;           // of caps that are fitted by integrals; empty: zero
  std::optional<int> max_numbers;  // of an atlas; none: as many as the shape has coordinates
  std::string method = "edge";
  std::string engine;  // empty: the default
  std::string center = "auto";
  bool allow_signed = false;
  std::optional<double> precision;
  bool no_errors = false;
  std::optional<int> samples, most_samples;  // Monte Carlo
  std::optional<double> deviation;
  std::uint64_t seed = MonteCarloOptions{}.seed;
  int rays = 100'000;
  double weld = 0;
  std::string length_unit;
  std::string columns;  // of points; empty: what the file says
  MemoryOptions memory;
  std::string output;
  std::string format;
  ConventionOptions convention;
  bool json = false;
};

// The whole command for the Monte Carlo methods; returns the exit code.
int analyze_by_monte_carlo(const AnalyzeCommandOptions& options, SamplePlaces places,
                           Session& session);

}  // namespace rholm::cli
