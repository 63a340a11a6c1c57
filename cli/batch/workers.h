// Rows of a batch on several threads. Layer: cli.
#pragma once

#include <cstddef>
#include <vector>

#include "cli/batch/job.h"

namespace rholm::cli {

// What the journal has not, by the size of the files; and how many of the rows it has had failed.
struct RowsToDo {
  std::vector<std::size_t> large, small;
  std::size_t failed = 0;
};
RowsToDo rows_to_do(const BatchJob& job, const BatchJournal& journal);

// Runs what the journal has not, and adds it there, with the session's progress. Small files are
// taken one on each thread, large ones one after the other on all; the results do not depend on it.
// False if it was interrupted; throws what the journal throws.
bool run_rows(const BatchJob& job, BatchJournal& journal, Session& session);

}  // namespace rholm::cli
