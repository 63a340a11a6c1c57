// rholm analyze with the pass over the mesh shared by ranks. Layer: mpi.
#pragma once

#include <functional>
#include <string>

#include "cli/grammar/command.h"
#include "cluster/ranks.h"

namespace rholm::mpi {

inline constexpr const char* kAnalyzeService = "analyze";

cli::Command analyze_command(Ranks* ranks);
// On other ranks, called for by the command; keeps the mesh from one call to the next.
std::function<void(Ranks& ranks, const std::string& bytes)> analyze_service();

}  // namespace rholm::mpi
