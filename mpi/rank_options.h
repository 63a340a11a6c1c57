// Options and inputs that all commands of rholm-mpi share. Layer: mpi.
#pragma once

#include <string>
#include <vector>

#include "cli/grammar/command.h"
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

// A file that every rank can open, where there are several: throws UsageError for standard input
// and pipes.
void check_input(const Ranks& ranks, const std::string& path);

}  // namespace rholm::mpi
