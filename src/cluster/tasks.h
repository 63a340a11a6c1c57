// Numbered tasks for all threads of all ranks. Layer: cluster, private.
//
// Rank 0 hands them out a few at a time, to itself as well: ranks that are faster get more. What a
// task gives does not depend on who does it, and results are taken by number; so what is made of
// them does not depend on the ranks. One list follows the other by a call() of all ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "cluster/ranks.h"

namespace rholm {

struct TaskList {
  std::vector<std::uint64_t> wide;    // first, one at a time, on all threads of a rank
  std::vector<std::uint64_t> narrow;  // then, one on each thread
};

// Does a task on so many threads; called by any thread. What it throws ends the run.
using DoTask = std::function<std::string(std::uint64_t task, int threads)>;
// Takes what a task gave, in the order in which they are done; called by one thread.
using TakeResult = std::function<void(std::uint64_t task, const std::string& bytes)>;

// On rank 0: returns when all results are taken. Throws what they throw, Stopped.
void lead_tasks(Ranks& ranks, const TaskList& tasks, int threads, const DoTask& work,
                const TakeResult& take);

// Tasks 0 ... count - 1, whose results are taken in that order; what is done, or waits for a
// result before it, is bounded by the number of threads.
struct OrderedTasks {
  std::uint64_t count = 0;
  // Rank r of R gets r count / R up to (r + 1) count / R, whatever the others do, and all results
  // may wait; else whoever is free gets the next one.
  bool dealt = false;
};
// False: no more is handed out, and what is under way is dropped.
using TakeNext = std::function<bool(std::uint64_t task, const std::string& bytes)>;
void lead_tasks(Ranks& ranks, const OrderedTasks& tasks, int threads, const DoTask& work,
                const TakeNext& take);

// On every other rank, at the same time: returns when nothing is left to be begun.
void serve_tasks(Ranks& ranks, int threads, const DoTask& work);

}  // namespace rholm
