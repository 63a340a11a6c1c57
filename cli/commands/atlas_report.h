// Atlases of caps in the commands analyze, info and synthesize. Layer: cli.
#pragma once

#include <string>

#include "cli/commands/analyze_options.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/compress.h"

namespace rholm::cli {

// Return a description of a model: caps, numbers, errors.
Json atlas_json(const AtlasModel& model);
std::string atlas_text(const AtlasModel& model);
// Returns the attributes of the surface that a model lacks: "attributes red, green, blue".
std::string left_out_text(const SurfaceRules& rules);

// Runs the whole command with --atlas; returns the exit code.
int analyze_atlas(const AnalyzeCommandOptions& options, Session& session);

// Runs rholm info for an atlas.
int report_atlas(const std::string& path, bool json);

}  // namespace rholm::cli
