// A computation as named stages: the pieces that each stage leaves in a store, its times, and the
// time left. Layer: parts, private.
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

// A stage and its cost relative to the other stages: only ratios count.
struct StageCost {
  std::string_view name;
  double cost = 0;
};

// Estimates the time left from the costs of stages done and to come. Stages that take no time,
// because an earlier run has done them, do not count.
class TimeLeft {
 public:
  // `stages` are all stages to come.
  explicit TimeLeft(const std::vector<StageCost>& stages);
  void add(const std::vector<StageCost>& stages);
  // Records that this part of a stage is done, `seconds` after the start of the run.
  void done(std::string_view stage, double part, double seconds);
  // Returns true once this run has done enough work to estimate the time left.
  bool is_known() const;
  double seconds() const;

 private:
  struct Stage {
    StageCost of;
    double done = 0;
  };
  std::vector<Stage> stages_;
  double worked_ = 0;   // sum of costs of the stages that took time
  double seconds_ = 0;  // time that these stages took
  double last_ = 0;     // time of the last call of done()
};

// Returns "3 min", "2 h 5 min" or "40 s", with no more digits than are known.
std::string text_of_seconds(double seconds);

// A stage whose parts 0 ... count - 1 are computed one at a time, each on all threads of a process.
struct Stage {
  std::string_view name;
  std::size_t count = 0;
  // Names of outputs: a part leaves the pieces OUTPUT/PART in the store. A part whose outputs are
  // all there, from an earlier run, is not computed again.
  std::vector<std::string> outputs = {};
  // Names of inputs INPUT/PART that no later stage reads. They are removed when the stage has
  // ended, unless the store is kept.
  std::vector<std::string> last_inputs = {};
};

// Runs the stages. All processes of the executor run the same stages in the same order, and share
// the store. A part leaves its results only there; all processes see them once the stage has ended.
class Stages {
 public:
  using Body = std::function<void(std::size_t part)>;

  // `costs` lists all stages; `context` receives each stage and the time left.
  Stages(Executor& executor, PieceStore& store, const std::vector<StageCost>& costs,
         StageTimes& times, const Context& context);
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  // Adds stages that are to come.
  void add(const std::vector<StageCost>& costs) { left_.add(costs); }

  // Runs the body for all parts.
  void each(const Stage& stage, const Body& body);
  void each(std::string_view stage, std::size_t count, const Body& body) {
    each({.name = stage, .count = count}, body);
  }
  // Returns the values of all parts, in the order of the parts. The values stay in the store as the
  // first output.
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
  // Runs the body in the process that leads.
  void once(std::string_view stage, const std::function<void()>& body);
  // Runs the body in each process.
  void all(std::string_view stage, const std::function<void()>& body);

  bool is_shared() const { return executor_.is_shared(); }

  // Returns the context for functions that bodies call: their progress is the stage's progress.
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
  std::mutex mutex_;  // guards left_ and what follows: the executor and a body may report
  std::string_view stage_;
  std::size_t done_ = 0, n_ = 0;  // parts of the stage
};

}  // namespace rholm
