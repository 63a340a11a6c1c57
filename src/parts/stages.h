// A computation as named stages: what each leaves in a store, how long it took, and when the whole
// will be done. Layer: parts, private.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "parts/executor.h"
#include "parts/store.h"
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
  // Whether work has been done in this run, from which the time that is left can be told.
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

// A stage whose parts 0 ... count - 1 are worked one at a time, each on all threads of a process.
struct Stage {
  std::string_view name;
  std::size_t count = 0;
  // A part leaves the pieces OUTPUT/PART in the store. Parts whose outputs are all there, from a
  // run before, are not worked again.
  std::vector<std::string> outputs = {};
  // Pieces INPUT/PART that no later stage reads are removed when the stage has ended, unless the
  // store is kept.
  std::vector<std::string> last_inputs = {};
};

// All processes of the executor go through the same stages in the same order, and share the store.
// A part leaves what it finds there only, where all see it once the stage has ended.
class Stages {
 public:
  using Body = std::function<void(std::size_t part)>;

  // The whole of it is `costs`; `context` is told of each stage, with the time that is left.
  Stages(Executor& executor, PieceStore& store, const std::vector<StageCost>& costs,
         StageTimes& times, const Context& context);
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  // More stages that are to come.
  void add(const std::vector<StageCost>& costs) { left_.add(costs); }

  // All parts.
  void each(const Stage& stage, const Body& body);
  void each(std::string_view stage, std::size_t count, const Body& body) {
    each({.name = stage, .count = count}, body);
  }
  // The values that all parts give, those of each behind those of the parts before it. They stay in
  // the store as the first output.
  template <class T, class Work>
  std::vector<T> values(const Stage& stage, const Work& work) {
    const std::string& output = stage.outputs.front();
    each(stage, [&](std::size_t part) { write_values(store_, name_of(output, part), work(part)); });
    std::vector<T> all;
    for (std::size_t part = 0; part < stage.count; ++part) {
      const PieceValues<T> own = read_values<T>(store_, name_of(output, part));
      all.insert(all.end(), own.begin(), own.end());
    }
    return all;
  }
  // By the process that leads.
  void once(std::string_view stage, const std::function<void()>& body);
  // By each process for itself.
  void all(std::string_view stage, const std::function<void()>& body);

  bool is_shared() const { return executor_.is_shared(); }

  // For what bodies call: its progress is that of the stage.
  const Context& context() const { return inner_; }
  StageTimes& times() { return times_; }

 private:
  static std::string name_of(const std::string& piece, std::size_t part) {
    return piece + "/" + std::to_string(part);
  }
  bool is_done(const Stage& stage, std::size_t part) const;
  void run(std::string_view stage, std::size_t n, const std::function<void()>& body);
  bool tell();
  double now() const;

  Executor& executor_;
  PieceStore& store_;
  StageTimes& times_;
  Context outer_, inner_;
  TimeLeft left_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;  // of what follows, and of left_: the executor may tell while a body does
  std::string_view stage_;
  std::size_t done_ = 0, n_ = 0;  // parts of the stage
};

}  // namespace rholm
