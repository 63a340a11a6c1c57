#include "studio/job.h"

namespace rholm::studio {
namespace {

constexpr auto kBetween = std::chrono::milliseconds(100);  // chosen: a bar seems to move

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

Context Job::context(int threads) {
  return {.threads = threads, .progress = [this](std::string_view stage, double fraction) {
            return on_progress(stage, fraction);
          }};
}

bool Job::on_progress(std::string_view stage, double fraction) {
  bool tell = false;
  {
    const std::lock_guard lock(mutex_);
    if (!stage.empty()) {
      stage_ = stage;
      fraction_ = fraction;
    }
    const auto now = std::chrono::steady_clock::now();
    tell = now - told_ >= kBetween;
    if (tell) told_ = now;
  }
  if (tell) changed_();
  return !cancelled_;
}

bool Job::running() const {
  const std::lock_guard lock(mutex_);
  return state_ == "running";
}

void Job::finish(const std::string& state, const std::string& message) {
  const std::lock_guard lock(mutex_);
  state_ = state;
  message_ = message;
  seconds_ = seconds_since(begin_);
  if (state == "done") fraction_ = 1;
}

Json Job::json() const {
  const std::lock_guard lock(mutex_);
  return {{"id", id_},
          {"label", label_},
          {"stage", stage_},
          {"fraction", fraction_},
          {"state", state_},
          {"message", message_},
          {"seconds", state_ == "running" ? seconds_since(begin_) : seconds_}};
}

}  // namespace rholm::studio
