// Chunks of a parallel loop on several threads, in one of two ways: by oneTBB (chunks_tbb.cpp), and
// on plain threads (chunks_threads.cpp) for ThreadSanitizer, which has to see how threads wait for
// each other, and does not see it in a library that was compiled without it.
#pragma once

#include <cstddef>
#include <functional>

namespace rholm {

// Where a function was called. (std::source_location is more than Clang 14 has.)
struct CallSite {
  const char* file = "";
  int line = 0;
};

// Calls run(chunk) once for each chunk of [0, chunks), on up to `threads` threads, at least 2. May
// be called by run itself, and by several threads at once. Throws the first exception of `run`;
// chunks that have not begun by then are left out. The plain threads note `where` the loop stands.
void run_chunks(std::size_t chunks, int threads, const std::function<void(std::size_t chunk)>& run,
                CallSite where);

// The number of threads that this machine, or what limits this process, is good for: at least 1.
int default_threads();

}  // namespace rholm
