// rholm batch with its rows distributed over ranks. Layer: mpi.
#pragma once

#include <string>

#include "cli/grammar/command.h"
#include "cluster/ranks.h"

namespace rholm::mpi {

inline constexpr const char* kBatchService = "batch";

cli::Command batch_command(Ranks* ranks);
// Serves the command on other ranks.
void serve_batch(Ranks& ranks, const std::string& bytes);

}  // namespace rholm::mpi
