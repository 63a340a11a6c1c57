// Runs loops on plain threads, without oneTBB (RHOLM_TBB=OFF) and for ThreadSanitizer
// (RHOLM_SANITIZE_THREAD). Threads wait for each other only at the beginning and at the end of a
// loop.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <functional>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "base/at_work.h"
#include "base/chunks.h"

namespace rholm {
namespace {

// True where ThreadSanitizer must see a race of any two chunks that touch the same memory, in
// whatever order they run. The thread of each chunk is then fixed beforehand.
#ifdef RHOLM_SANITIZE_THREAD
constexpr bool kShowsRaces = true;
#else
constexpr bool kShowsRaces = false;
#endif

// Chosen: the smallest number that shows every race of two chunks, and each race of three chunks
// that two threads would hide. More threads than requested change no result, because chunks do not
// depend on them.
constexpr std::size_t kLeastThreads = 4;

// Number of threads that loops of this process have started and that have not ended.
std::atomic<std::size_t> extra_threads = 0;

// Returns the number of threads that a loop starts. Nested loops would start the square of
// `threads`; chosen: all loops together start at most twice `threads`.
std::size_t threads_to_start(std::size_t chunks, std::size_t threads) {
  if (kShowsRaces) return std::min(chunks, std::max(threads, kLeastThreads)) - 1;
  const std::size_t running = extra_threads.load(std::memory_order_relaxed);
  return std::min({chunks - 1, threads - 1, 2 * threads - std::min(2 * threads, running)});
}

// Appends the place of a loop to the file that RHOLM_LOOPS names (scripts/check_loops), at every
// call. Remembering the places already written would order the loops, as a lock does, and hide
// races.
void note(CallSite where) {
  if (!kShowsRaces) return;
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
  const std::size_t n = 1 + threads_to_start(chunks, static_cast<std::size_t>(threads));
  // The order is relaxed: other threads need not see here what a chunk has written.
  std::atomic<bool> go_on = true;
  std::atomic<std::size_t> next = 0;
  const auto take = [&](std::size_t settled) {
    return kShowsRaces ? settled : next.fetch_add(1, std::memory_order_relaxed);
  };
  const auto run_some = [&](std::size_t thread) {
    for (std::size_t c = take(thread); c < chunks && go_on.load(std::memory_order_relaxed);
         c = take(c + n)) {
      if (!run(c)) go_on.store(false, std::memory_order_relaxed);
    }
  };
  AtWork others(static_cast<int>(n - 1));
  std::vector<std::jthread> workers;
  workers.reserve(n - 1);
  extra_threads.fetch_add(n - 1, std::memory_order_relaxed);
  for (std::size_t thread = 1; thread < n; ++thread) {
    try {
      workers.emplace_back([&, thread] {
        run_some(thread);
        others.end();
      });
    } catch (const std::system_error&) {
      // The system has no more threads; the threads that have started take all chunks.
      if (kShowsRaces) throw;
      others.end();
    }
  }
  run_some(0);
  others.wait(wait);
  workers.clear();  // waits for the threads
  extra_threads.fetch_sub(n - 1, std::memory_order_relaxed);
}

}  // namespace rholm
