// Report of rholm analyze. Layer: cli.
#pragma once

#include <string>

#include "cli/commands/analyze_options.h"
#include "cli/terminal/json_text.h"
#include "rholm/model.h"

namespace rholm::cli {

// Results and times of a run.
struct AnalyzeRun {
  Encoded encoded;
  double diagonal = 0;
  StageTimes times;
};

Json analyze_json(const AnalyzeCommandOptions& options, const AnalyzeRun& run);
std::string analyze_text(const AnalyzeCommandOptions& options, const AnalyzeRun& run);

std::uint64_t peak_memory_bytes();

}  // namespace rholm::cli
