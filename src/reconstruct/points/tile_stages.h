// The stages of work on tiles: their times, and when the whole will be done. Layer: reconstruct,
// private.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "parts/executor.h"
#include "rholm/context.h"

namespace rholm {

// A stage and what it costs, as a part of the whole: only ratios count.
struct StageCost {
  std::string_view name;
  double cost = 0;
};

// Time that is left, from the costs of what is done and what is not. Stages that take no time at
// all, as they were done by a run before, do not count.
class TimeLeft {
 public:
  // All stages to come.
  explicit TimeLeft(const std::vector<StageCost>& stages);
  void add(const std::vector<StageCost>& stages);
  // This part of a stage is done, after so many seconds since the begin.
  void done(std::string_view stage, double part, double seconds);
  // A part of the work that has not been done by others before is done; and what is left of it is.
  bool is_known() const;
  double seconds() const;

 private:
  struct Stage {
    StageCost of;
    double done = 0;
  };
  std::vector<Stage> stages_;
  double worked_ = 0;   // costs of what took time
  double seconds_ = 0;  // that these took
  double last_ = 0;     // when it was asked last
};

// "3 min", "2 h 5 min", "40 s": no more digits than are known.
std::string text_of_seconds(double seconds);

class TileStages {
 public:
  using Body = std::function<void(std::size_t tile)>;

  // The whole of it is `costs`; `context` is told of each stage, with the time that is left.
  TileStages(Executor& executor, const std::vector<StageCost>& costs, StageTimes& times,
             const Context& context);
  TileStages(const TileStages&) = delete;
  TileStages& operator=(const TileStages&) = delete;

  // More that is to come.
  void add(const std::vector<StageCost>& costs) { left_.add(costs); }

  // For all tiles, one at a time on all threads of a process. A body leaves what it finds in the
  // store, where all processes see it once the stage has ended.
  void each(std::string_view stage, std::size_t n, const Body& body);
  // By the process that leads.
  void once(std::string_view stage, const std::function<void()>& body);
  // By each process for itself.
  void all(std::string_view stage, const std::function<void()>& body);

  bool is_shared() const { return executor_.is_shared(); }

  // For what bodies call: progress of theirs is that of the stage.
  const Context& context() const { return inner_; }
  StageTimes& times() { return times_; }

 private:
  void run(std::string_view stage, std::size_t n, const std::function<void()>& body);
  bool tell();
  double now() const;

  Executor& executor_;
  StageTimes& times_;
  Context outer_, inner_;
  TimeLeft left_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;  // of what follows, and of left_: an executor may tell while a body does
  std::string_view stage_;
  std::size_t done_ = 0, n_ = 0;  // tiles of the stage
};

}  // namespace rholm
