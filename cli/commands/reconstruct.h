// "rholm reconstruct" with an exchangeable function for tiles. Layer: cli.
#pragma once

#include <functional>

#include "cli/files/points_input.h"
#include "cli/grammar/command.h"
#include "cli/terminal/session.h"
#include "rholm/reconstruct.h"

namespace rholm::cli {

// Type of the library's reconstruct() with an output.
using RunTiles = std::function<Reconstruction(const PointsInput& points,
                                              const ReconstructOptions& options, Session& session)>;

// Makes the command. `several` returns true if several processes share the folder of --work-dir.
Command reconstruct_command_by(RunTiles run, std::function<bool()> several);

}  // namespace rholm::cli
