#include "parts/stages.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/parallel.h"
#include "base/stopwatch.h"

namespace rholm {
namespace {

// Steps that took less time were done by an earlier run: only their pieces were searched.
constexpr double kDoneBefore = 0.002;  // seconds for each step
// Seconds before the time left is reported: first stages predict little about others.
constexpr double kSilent = 10;

}  // namespace

TimeLeft::TimeLeft(const std::vector<StageCost>& stages) { add(stages); }

void TimeLeft::add(const std::vector<StageCost>& stages) {
  stages_.reserve(stages_.size() + stages.size());
  for (const StageCost& stage : stages) stages_.push_back({stage});
}

void TimeLeft::done(std::string_view stage, double part, double seconds) {
  const auto at = std::find_if(stages_.begin(), stages_.end(),
                               [&](const Stage& one) { return one.of.name == stage; });
  const double spent = seconds - last_;
  last_ = seconds;
  if (at == stages_.end() || part <= at->done) {
    seconds_ += spent;
    return;
  }
  if (spent > kDoneBefore) {
    worked_ += at->of.cost * (part - at->done);
    seconds_ += spent;
  }
  at->done = part;
}

bool TimeLeft::is_known() const { return worked_ > 0 && seconds_ > kSilent; }

double TimeLeft::seconds() const {
  double left = 0;
  for (const Stage& stage : stages_) left += stage.of.cost * (1 - stage.done);
  return worked_ > 0 ? seconds_ * left / worked_ : 0;
}

std::string text_of_seconds(double seconds) {
  if (seconds < 55) return fmt::format("{:.0f} s", std::max(5.0, 5 * std::round(seconds / 5)));
  const auto minutes = static_cast<long>(std::round(seconds / 60));
  if (minutes < 60) return fmt::format("{} min", minutes);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

Stages::Stages(Executor& executor, PieceStore& store, const std::vector<StageCost>& costs,
               StageTimes& times, const Context& context)
    : executor_(executor),
      store_(store),
      times_(times),
      outer_(context),
      inner_(context),
      left_(costs) {
  if (!outer_.progress) return;
  inner_.progress = [this](std::string_view stage, double) {
    const std::lock_guard lock(mutex_);
    return stage.empty() ? outer_.progress(stage, 0) : tell();
  };
}

double Stages::now() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

bool Stages::tell() {
  const double part = n_ > 0 ? static_cast<double>(done_) / static_cast<double>(n_) : 0;
  if (!left_.is_known()) return outer_.progress(stage_, part);
  return outer_.progress(fmt::format("{}, {} left", stage_, text_of_seconds(left_.seconds())),
                         part);
}

void Stages::run(std::string_view stage, std::size_t n, const std::function<void()>& body) {
  {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    done_ = 0, n_ = n;
  }
  report_progress(inner_, stage, 0);
  timed(times_, std::string(stage), [&] {
    body();
    return 0;
  });
  const std::lock_guard lock(mutex_);
  left_.done(stage, 1, now());
}

bool Stages::is_done(const Stage& stage, std::size_t part) const {
  return !stage.outputs.empty() && std::ranges::all_of(stage.outputs, [&](const auto& output) {
    return store_.has(name_of(output, part));
  });
}

void Stages::each(const Stage& stage, const Body& body) {
  const auto work = [&](std::size_t part, int) {
    if (!is_done(stage, part)) body(part);
    return std::string();
  };
  const auto take = [&](std::size_t, const std::string&) {
    {
      const std::lock_guard lock(mutex_);
      left_.done(stage.name, static_cast<double>(++done_) / static_cast<double>(stage.count),
                 now());
    }
    report_progress(inner_, stage.name, 0);
  };
  run(stage.name, stage.count, [&] {
    executor_.run({.count = stage.count, .wide = stage.count, .in_order = false}, work, take);
  });
  if (stage.last_inputs.empty()) return;
  once(stage.name, [&] {
    if (store_.is_kept()) return;
    for (const std::string& input : stage.last_inputs) {
      for (std::size_t part = 0; part < stage.count; ++part) store_.remove(name_of(input, part));
    }
  });
}

void Stages::once(std::string_view stage, const std::function<void()>& body) {
  run(stage, 0, [&] { executor_.once(body); });
}

void Stages::all(std::string_view stage, const std::function<void()>& body) { run(stage, 0, body); }

}  // namespace rholm
