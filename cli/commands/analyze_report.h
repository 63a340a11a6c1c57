// What rholm analyze says of a run. Layer: cli.
#pragma once

#include <string>

#include "cli/commands/analyze_options.h"
#include "cli/terminal/json_text.h"
#include "rholm/model.h"

namespace rholm::cli {

// A run: what was found, and how long it took.
struct AnalyzeRun {
  Encoded encoded;
  double diagonal = 0;
  StageTimes times;
};

Json analyze_json(const AnalyzeCommandOptions& options, const AnalyzeRun& run);
std::string analyze_text(const AnalyzeCommandOptions& options, const AnalyzeRun& run);

std::uint64_t peak_memory_bytes();

}  // namespace rholm::cli
