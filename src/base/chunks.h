// Chunks of a parallel loop on several threads: by oneTBB (chunks_tbb.cpp), or on plain threads
// (chunks_threads.cpp). ThreadSanitizer needs plain threads: it does not see how threads wait for
// each other in a library that was compiled without it.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

namespace rholm {

// Where a function was called. (std::source_location is more than Clang 14 has.)
struct CallSite {
  const char* file = "";
  int line = 0;
};

// Calls run(chunk) once for each chunk of [0, chunks), on this and up to `threads` - 1 other
// threads, `threads` at least 2. Where `run` returns false, chunks that have not begun are left
// out. While this thread waits for the others it calls `wait` every few milliseconds. Neither may
// throw. May be called by `run` itself, and by several threads at once. For
// ThreadSanitizer it is noted `where` the loop stands.
void run_chunks(std::size_t chunks, int threads, const std::function<bool(std::size_t chunk)>& run,
                const std::function<void()>& wait, CallSite where);

// Calls run() where loops of oneTBB, those of other libraries too, have that many threads at most.
void run_limited(int threads, const std::function<void()>& run);

// Between two calls of `wait`; chosen, a tenth of what a user who interrupts notices.
constexpr std::chrono::milliseconds kWaitInterval{10};

// The number of threads that this machine, or what limits this process, is good for: at least 1.
int default_threads();

}  // namespace rholm
