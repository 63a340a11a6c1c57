// rholm batch with an exchangeable way to run rows. Layer: cli.
#pragma once

#include <functional>

#include "cli/batch/job.h"
#include "cli/grammar/command.h"
#include "cli/terminal/session.h"
#include "rholm/batch.h"

namespace rholm::cli {

// Runs rows that are not in the journal, and adds them; returns false if interrupted.
using RunRows = std::function<bool(const BatchJob& job, BatchJournal& journal, Session& session)>;

// Makes the command that runs its rows with this function.
Command batch_command_by(const RunRows& run_rows);

// Returns the functions of this program that a batch needs.
BatchCommands commands_for_batches();

}  // namespace rholm::cli
