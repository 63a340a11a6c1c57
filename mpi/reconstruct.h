// "rholm-mpi reconstruct": tiles distributed over ranks. Layer: mpi.
#pragma once

#include <string>

#include "cli/grammar/command.h"
#include "cluster/ranks.h"

namespace rholm::mpi {

inline constexpr const char* kReconstructService = "reconstruct";

// Returns the command of rank 0.
cli::Command reconstruct_command(Ranks* ranks);
// Serves the command on other ranks.
void serve_reconstruct(Ranks& ranks, const std::string& bytes);

}  // namespace rholm::mpi
