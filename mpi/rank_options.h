// Options and inputs of all commands of rholm-mpi. Layer: mpi.
#pragma once

#include <string>
#include <vector>

#include "cli/grammar/command.h"
#include "cluster/ranks.h"

namespace rholm::mpi {

// Options of every command besides --threads and --quiet.
struct RankOptions {
  double patience = 300;
  bool timings = false;
  std::vector<std::string> words = {};  // the command line itself
};
// Returns the options; --threads applies to each rank.
std::vector<cli::Option> rank_options(RankOptions& options);

// Checks that every rank can open a file, if there are several: throws UsageError for standard
// input and pipes.
void check_input(const Ranks& ranks, const std::string& path);

}  // namespace rholm::mpi
