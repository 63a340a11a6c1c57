// Work on its own thread, with its status for waiting pages. Layer: studio.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>

#include "rholm/context.h"
#include "studio/items/fields.h"

namespace rholm::studio {

class Job {
 public:
  // `changed` is called from the job's thread when the
  // status has changed, at most some times per second.
  Job(int id, std::string label, std::function<void()> changed)
      : id_(id), label_(std::move(label)), changed_(std::move(changed)) {}

  int id() const { return id_; }
  // Returns a context for the library that records progress and ends the work when cancelled.
  Context context(int threads);
  void cancel() { cancelled_ = true; }
  bool cancelled() const { return cancelled_; }
  bool running() const;
  // Sets the final state: "done", "failed", "cancelled".
  void finish(const std::string& state, const std::string& message = {});
  Json json() const;

 private:
  bool on_progress(std::string_view stage, double fraction);

  const int id_;
  const std::string label_;
  const std::function<void()> changed_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::atomic<bool> cancelled_{false};
  mutable std::mutex mutex_;  // guards the fields below
  std::string stage_, state_ = "running", message_;
  double fraction_ = 0, seconds_ = 0;
  std::chrono::steady_clock::time_point told_ = begin_;
};

}  // namespace rholm::studio
