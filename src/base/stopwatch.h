// Wall and processor time of stages. Layer: base.
#pragma once

#include <time.h>

#include <chrono>
#include <map>
#include <string>

#include "rholm/context.h"

namespace rholm {

inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Adds the time between its construction and its destruction to a stage.
class StageTimer {
 public:
  StageTimer(StageTimes& times, const std::string& stage)
      : time_(times[stage]), wall_(std::chrono::steady_clock::now()), cpu_(cpu_seconds()) {}
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;
  ~StageTimer() {
    time_.wall += std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
    time_.cpu += cpu_seconds() - cpu_;
  }

 private:
  StageTime& time_;
  std::chrono::steady_clock::time_point wall_;
  double cpu_;
};

// Runs a stage and records its times.
template <typename Stage>
auto timed(StageTimes& times, const std::string& name, const Stage& stage) {
  const StageTimer timer(times, name);
  return stage();
}

}  // namespace rholm
