// Report of rholm expand. Layer: cli.
#pragma once

#include <string>

#include "cli/commands/expand_options.h"
#include "cli/terminal/json_text.h"
#include "rholm/model.h"

namespace rholm::cli {

// Results and times of a run.
struct ExpandRun {
  Expanded expanded;
  double diagonal = 0;
  StageTimes times;
};

// Returns the first entries of a report: file, output, degree, method, function.
Json report_head(const ExpandCommandOptions& options, const Expansion& expansion);

Json expand_json(const ExpandCommandOptions& options, const ExpandRun& run);
std::string expand_text(const ExpandCommandOptions& options, const ExpandRun& run);

std::uint64_t peak_memory_bytes();

}  // namespace rholm::cli
