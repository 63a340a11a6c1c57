// rholm analyze with the pass over the mesh distributed over ranks. Layer: mpi.
#pragma once

#include <functional>
#include <string>

#include "cli/grammar/command.h"
#include "cluster/ranks.h"

namespace rholm::mpi {

inline constexpr const char* kAnalyzeService = "analyze";

cli::Command analyze_command(Ranks* ranks);
// Returns the service of other ranks for the command; it keeps the mesh between calls.
std::function<void(Ranks& ranks, const std::string& bytes)> analyze_service();

}  // namespace rholm::mpi
