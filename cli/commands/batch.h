// rholm batch, whoever runs the rows. Layer: cli.
#pragma once

#include <functional>

#include "cli/batch/job.h"
#include "cli/grammar/command.h"
#include "cli/terminal/session.h"
#include "rholm/batch.h"

namespace rholm::cli {

// Runs the rows that the journal has not, and adds them to it; false if it was interrupted.
using RunRows = std::function<bool(const BatchJob& job, BatchJournal& journal, Session& session)>;

// The command with its rows run in that way.
Command batch_command_by(const RunRows& run_rows);

// What a batch needs to know of the commands of this program.
BatchCommands commands_for_batches();

}  // namespace rholm::cli
