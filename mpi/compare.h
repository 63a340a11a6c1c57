// rholm compare with its samples measured by ranks. Layer: mpi.
#pragma once

#include <memory>
#include <string>

#include "cli/grammar/command.h"
#include "cluster/ranks.h"
#include "mpi/rank_options.h"

namespace rholm::mpi {

inline constexpr const char* kCompareService = "compare";

cli::Command compare_command(Ranks* ranks, const std::shared_ptr<RankOptions>& options);
// On other ranks, called for by the command.
void serve_compare(Ranks& ranks, const std::string& bytes);

}  // namespace rholm::mpi
