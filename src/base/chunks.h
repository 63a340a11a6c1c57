// Runs the chunks of a parallel loop on several threads: by oneTBB (chunks_tbb.cpp), or on plain
// threads (chunks_threads.cpp). ThreadSanitizer needs plain threads: it does not see how threads
// wait for each other in a library that was compiled without it.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

namespace rholm {

// The place where a function was called. (Clang 14 does not support all of std::source_location.)
struct CallSite {
  const char* file = "";
  int line = 0;
};

// Calls run(chunk) once for each chunk of [0, chunks), on this thread and up to `threads` - 1
// others; `threads` is at least 2. Once `run` returns false, chunks that have not begun are left
// out. While this thread waits for the others, it calls `wait` every few milliseconds. Neither
// function may throw. `run` itself and several threads at once may call run_chunks(). With
// ThreadSanitizer, `where` the loop stands is recorded.
void run_chunks(std::size_t chunks, int threads, const std::function<bool(std::size_t chunk)>& run,
                const std::function<void()>& wait, CallSite where);

// Calls run(), and limits all loops of oneTBB in it, also in other libraries, to `threads` threads.
void run_limited(int threads, const std::function<void()>& run);

// Time between two calls of `wait`. Chosen: a tenth of what a user who interrupts notices.
constexpr std::chrono::milliseconds kWaitInterval{10};

// Returns the number of threads that this machine and the limits of this process allow: at least 1.
int default_threads();

}  // namespace rholm
