// "rholm-mpi reconstruct": tiles over ranks. Layer: mpi.
#pragma once

#include <string>

#include "cli/grammar/command.h"
#include "cluster/ranks.h"

namespace rholm::mpi {

inline constexpr const char* kReconstructService = "reconstruct";

// On rank 0.
cli::Command reconstruct_command(Ranks* ranks);
// On the others.
void serve_reconstruct(Ranks& ranks, const std::string& bytes);

}  // namespace rholm::mpi
