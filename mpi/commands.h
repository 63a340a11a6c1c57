// The commands of rholm-mpi. Layer: mpi.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/grammar/help.h"
#include "cluster/collect.h"
#include "cluster/ranks.h"
#include "mpi/rank_options.h"

namespace rholm::mpi {

// Returns the commands of rank 0: each runs there and calls the other ranks. `ranks` may be null if
// commands are only described.
std::vector<cli::Command> commands(Ranks* ranks, const std::shared_ptr<RankOptions>& options);

// Returns the services of other ranks.
Services services();

// Returns the program's description of itself.
cli::ProgramText about();

}  // namespace rholm::mpi
