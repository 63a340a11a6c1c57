// rholm compare with its measurements distributed over ranks. Layer: mpi.
#pragma once

#include <memory>
#include <string>

#include "cli/grammar/command.h"
#include "cluster/ranks.h"
#include "mpi/rank_options.h"

namespace rholm::mpi {

inline constexpr const char* kCompareService = "compare";

cli::Command compare_command(Ranks* ranks, const std::shared_ptr<RankOptions>& options);
// Serves the command on other ranks.
void serve_compare(Ranks& ranks, const std::string& bytes);

}  // namespace rholm::mpi
