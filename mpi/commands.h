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

// On rank 0: each runs there and calls the others. `ranks` may be null where commands are only
// described.
std::vector<cli::Command> commands(Ranks* ranks, const std::shared_ptr<RankOptions>& options);

// What other ranks are called for.
Services services();

// What the program says of itself.
cli::ProgramText about();

}  // namespace rholm::mpi
