// Plain threads, for ThreadSanitizer (RHOLM_SANITIZE_THREAD): they wait for each other at the
// beginning and at the end of a loop, and nowhere between, so that any two chunks that touch the
// same memory are a race that is seen, whichever runs first.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/chunks.h"

namespace rholm {
namespace {

// As few as show every race of two chunks, and of three that two would hide; chosen. Threads that
// were not asked for change no result: chunks do not depend on them.
constexpr std::size_t kLeastThreads = 4;

// Adds the place of a loop to the file that RHOLM_LOOPS names (scripts/check_loops), each time:
// what knows which are there already would put loops in an order, as a lock does, and hide races.
void note(CallSite where) {
  static const char* const name = std::getenv("RHOLM_LOOPS");
  if (name == nullptr) return;
  static const int file = open(name, O_WRONLY | O_APPEND | O_CREAT, 0666);
  const std::string line = fmt::format("{}:{}\n", where.file, where.line);
  if (write(file, line.data(), line.size()) < 0) std::abort();
}

}  // namespace

int default_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void run_chunks(std::size_t chunks, int threads, const std::function<void(std::size_t)>& run,
                CallSite where) {
  note(where);
  const std::size_t n = std::min(chunks, std::max<std::size_t>(threads, kLeastThreads));
  std::mutex mutex;
  std::exception_ptr first;  // guarded by the mutex
  std::atomic<bool> failed = false;
  const auto run_every_nth = [&](std::size_t begin) {
    // Relaxed: what a chunk has written is not for the others to see.
    for (std::size_t c = begin; c < chunks && !failed.load(std::memory_order_relaxed); c += n) {
      try {
        run(c);
      } catch (...) {
        failed.store(true, std::memory_order_relaxed);
        const std::lock_guard lock(mutex);
        if (!first) first = std::current_exception();
      }
    }
  };
  std::vector<std::jthread> workers;
  for (std::size_t begin = 1; begin < n; ++begin) workers.emplace_back(run_every_nth, begin);
  run_every_nth(0);
  workers.clear();  // waits for them
  if (first) std::rethrow_exception(first);
}

}  // namespace rholm
