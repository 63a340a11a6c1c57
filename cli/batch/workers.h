// Rows of a batch, by an executor. Layer: cli.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "cli/batch/job.h"
#include "cli/terminal/session.h"
#include "io/file/temporary_folder.h"
#include "parts/executor.h"

namespace rholm::cli {

// Rows that the journal has not. Large files come first, each of which has all threads.
struct RowsToDo {
  std::vector<std::size_t> rows;
  std::size_t n_large = 0;
  std::size_t failed = 0;  // of the rows that the journal has
};
RowsToDo rows_to_do(const BatchJob& job, const BatchJournal& journal);

// Part k is row rows[k], which it gives as bytes; files that are not kept go to `scratch`. All
// three outlive it. Throws Cancelled if it is interrupted.
Executor::Work row_work(const BatchJob& job, const std::vector<std::size_t>& rows,
                        const TemporaryFolder& scratch);

// Has the rows worked and adds them to the journal, with the session's progress; `added` is called
// after each. The results do not depend on the executor. Throws what it and the journal throw.
void work_rows(const BatchJob& job, const RowsToDo& to_do, BatchJournal& journal,
               Executor& executor, Session& session, const std::function<void()>& added);
// On the threads of the session. False if it was interrupted.
bool run_rows(const BatchJob& job, BatchJournal& journal, Session& session);

}  // namespace rholm::cli
