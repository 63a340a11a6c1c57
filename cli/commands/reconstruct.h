// "rholm reconstruct", by whoever works on tiles. Layer: cli.
#pragma once

#include <functional>

#include "cli/files/points_input.h"
#include "cli/grammar/command.h"
#include "cli/terminal/session.h"
#include "rholm/reconstruct.h"

namespace rholm::cli {

// As reconstruct() of the library, with an output.
using RunTiles = std::function<Reconstruction(const PointsInput& points,
                                              const ReconstructOptions& options, Session& session)>;

// `several` tells whether several processes share the folder of --work-dir.
Command reconstruct_command_by(RunTiles run, std::function<bool()> several);

}  // namespace rholm::cli
