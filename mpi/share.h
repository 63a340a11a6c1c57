// Tasks of a computation on rank 0 that other ranks do, too. Layer: mpi.
#pragma once

#include <string>

#include "base/shared_tasks.h"
#include "cluster/ranks.h"

namespace rholm::mpi {

// On rank 0: has the service `name` of all others do tasks of a job; `subject` is what they are
// about. Invalid input that a task finds is thrown where the tasks are shared, once, as if they had
// been done there; all else that one throws ends the run. `threads` of each rank; 0: its share.
ShareTasks share_over(Ranks& ranks, const std::string& name, const std::string& subject,
                      int threads);

// The same where the others have been called, and share at the same time: jobs are not told.
ShareTasks share_with_all(Ranks& ranks, int threads);

// What such a service is called with.
struct SharedCall {
  int threads = 0;
  std::string subject, job;
};
SharedCall shared_call(const std::string& bytes);
// On other ranks.
void serve_shared(Ranks& ranks, int threads, const DoSharedTask& work);

// Of this rank: what was asked for, or, of 0, its share of the processors.
int threads_here(const Ranks& ranks, int wanted);

// A file that every rank can open, where there are several: throws UsageError for standard input
// and pipes.
void check_input(const Ranks& ranks, const std::string& path);

}  // namespace rholm::mpi
