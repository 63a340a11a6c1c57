// "rholm reconstruct", by whoever works on bricks. Layer: cli.
#pragma once

#include <filesystem>
#include <functional>

#include "cli/files/points_input.h"
#include "cli/grammar/command.h"
#include "cli/terminal/session.h"
#include "rholm/reconstruct_bricks.h"

namespace rholm::cli {

// As reconstruct_bricks() of the library.
using RunBricks = std::function<BrickReconstruction(
    const PointsInput& points, const std::filesystem::path& mesh, const ReconstructOptions& options,
    const BrickOptions& bricks, Session& session)>;

// `several` tells whether several processes share the folder of --work-dir.
Command reconstruct_command_by(RunBricks run, std::function<bool()> several);

}  // namespace rholm::cli
