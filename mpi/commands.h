// The commands of rholm-mpi. Layer: mpi.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "cli/grammar/help.h"
#include "cluster/collect.h"
#include "cluster/ranks.h"

namespace rholm::mpi {

// What every command can be told besides --threads and --quiet.
struct RankOptions {
  double patience = 300;
  bool timings = false;
  std::vector<std::string> words = {};  // the command line itself
};
// --threads is of each rank.
std::vector<cli::Option> rank_options(RankOptions& options);

// On rank 0: each runs there and calls the others. `ranks` may be null where commands are only
// described.
std::vector<cli::Command> commands(Ranks* ranks, const std::shared_ptr<RankOptions>& options);

// What other ranks are called for.
Services services();

// What the program says of itself.
cli::ProgramText about();

}  // namespace rholm::mpi
