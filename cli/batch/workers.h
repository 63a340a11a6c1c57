// Runs the rows of a batch with an executor. Layer: cli.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "cli/batch/job.h"
#include "cli/terminal/session.h"
#include "io/file/temporary_folder.h"
#include "parts/executor.h"

namespace rholm::cli {

// Rows that are not in the journal. Large files come first; each of them uses all threads.
struct RowsToDo {
  std::vector<std::size_t> rows;
  std::size_t n_large = 0;
  std::size_t failed = 0;  // number of failed rows in the journal
};
RowsToDo rows_to_do(const BatchJob& job, const BatchJournal& journal);

// Returns the work whose part k runs row rows[k] and returns it as bytes. Files that are not kept
// go to `scratch`. The arguments must outlive it. Throws Cancelled if interrupted.
Executor::Work row_work(const BatchJob& job, const std::vector<std::size_t>& rows,
                        const TemporaryFolder& scratch);

// Runs the rows and adds them to the journal, with the session's progress; calls `added` after
// each. Results do not depend on the executor. Throws errors of executor and journal.
void work_rows(const BatchJob& job, const RowsToDo& to_do, BatchJournal& journal,
               Executor& executor, Session& session, const std::function<void()>& added);
// Runs the rows on threads of this session. Returns false if interrupted.
bool run_rows(const BatchJob& job, BatchJournal& journal, Session& session);

}  // namespace rholm::cli
