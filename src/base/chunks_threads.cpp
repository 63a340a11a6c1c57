// Plain threads, for ThreadSanitizer (RHOLM_SANITIZE_THREAD): they wait for each other at the
// beginning and at the end of a loop, and nowhere between, so that any two chunks that touch the
// same memory are a race that is seen, whichever runs first.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
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

void run_limited(int, const std::function<void()>& run) { run(); }

int default_threads() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void run_chunks(std::size_t chunks, int threads, const std::function<bool(std::size_t)>& run,
                const std::function<void()>& wait, CallSite where) {
  note(where);
  const std::size_t n = std::min(chunks, std::max<std::size_t>(threads, kLeastThreads));
  // Relaxed: what a chunk has written is not for the others to see.
  std::atomic<bool> go_on = true;
  std::atomic<std::size_t> at_work = n - 1;
  const auto run_every_nth = [&](std::size_t begin) {
    for (std::size_t c = begin; c < chunks && go_on.load(std::memory_order_relaxed); c += n) {
      if (!run(c)) go_on.store(false, std::memory_order_relaxed);
    }
  };
  std::vector<std::jthread> workers;
  for (std::size_t begin = 1; begin < n; ++begin) {
    workers.emplace_back([&, begin] {
      run_every_nth(begin);
      at_work.fetch_sub(1, std::memory_order_relaxed);
    });
  }
  run_every_nth(0);
  for (auto due = std::chrono::steady_clock::now() + kWaitInterval;
       at_work.load(std::memory_order_relaxed) > 0; std::this_thread::yield()) {
    if (std::chrono::steady_clock::now() < due) continue;
    wait();
    due += kWaitInterval;
  }
  workers.clear();  // waits for them
}

}  // namespace rholm
