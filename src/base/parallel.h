// Parallel loops with progress and cancellation.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>

#include "base/chunks.h"
#include "rholm/context.h"

namespace rholm {

// Calls body(begin, end) for the chunks [0, grain), [grain, 2 grain), ... of [0, n), on several
// threads. Chunks do not depend on the number of threads. So a body that writes only data of its
// own chunk gives the same bits for any number of threads. Progress is reported under `stage`, from
// `from` to `to`. An empty stage still asks whether to cancel, with the name "" and these
// fractions. Throws Error{kCancelled}, or the first exception of a body. Tests check by `where`
// that every loop ran on several threads.
struct ParallelStage {
  std::string_view name = {};
  double from = 0;
  double to = 1;
};
void parallel_for(std::size_t n, std::size_t grain, const Context& context,
                  const ParallelStage& stage,
                  const std::function<void(std::size_t begin, std::size_t end)>& body,
                  CallSite where = {__builtin_FILE(), __builtin_LINE()});

// Reports progress between serial steps; throws Error{kCancelled} if the callback says so.
void report_progress(const Context& context, std::string_view stage, double fraction);

// Returns the number of threads that `context` asks for: at least 1.
int thread_count(const Context& context);

}  // namespace rholm
