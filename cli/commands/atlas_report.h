// Atlases of caps on the command line: what analyze, info and synthesize do with them. Layer: cli.
#pragma once

#include <string>

#include "cli/commands/analyze_options.h"
#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/compress.h"

namespace rholm::cli {

// Caps, numbers, errors: what a model says of itself.
Json atlas_json(const AtlasModel& model);
std::string atlas_text(const AtlasModel& model);
// "attributes red, green, blue": what a model does not hold of its surface.
std::string left_out_text(const SurfaceRules& rules);

// The whole command with --atlas; returns the exit code.
int analyze_atlas(const AnalyzeCommandOptions& options, Session& session);

// rholm info for an atlas.
int report_atlas(const std::string& path, bool json);

}  // namespace rholm::cli
