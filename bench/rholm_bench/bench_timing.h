// Repeated measurements and their summaries.
#pragma once

#include <algorithm>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "rholm/context.h"

namespace rholm {

// Wall and processor time of repeated runs.
struct Timing {
  StageTime median;
  StageTime minimum;
};

inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return (values[(n - 1) / 2] + values[n / 2]) / 2;
}

inline Timing timing_of(const std::vector<StageTime>& runs) {
  std::vector<double> wall, cpu;
  for (const StageTime& run : runs) {
    wall.push_back(run.wall);
    cpu.push_back(run.cpu);
  }
  if (runs.empty()) return {};
  return {.median = {median(wall), median(cpu)},
          .minimum = {*std::min_element(wall.begin(), wall.end()),
                      *std::min_element(cpu.begin(), cpu.end())}};
}

template <typename Work>
StageTime time_once(const Work& work) {
  StageTimes times;
  timed(times, "", work);
  return times[""];
}

// Measures work that is repeated.
template <typename Work>
Timing time_repeated(int repeat, const Context& context, const Work& work) {
  std::vector<StageTime> runs;
  for (int i = 0; i < repeat; ++i) {
    report_progress(context, "measure", static_cast<double>(i) / repeat);
    runs.push_back(time_once(work));
  }
  return timing_of(runs);
}

// Returns a context for measured work: `threads` threads, reporting the progress of the whole.
inline Context measured(const Context& context, int threads, double fraction) {
  Context inner{.threads = threads};
  if (context.progress) {
    inner.progress = [&context, fraction](std::string_view, double) {
      return context.progress("measure", fraction);
    };
  }
  return inner;
}

}  // namespace rholm
