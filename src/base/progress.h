// Progress of work that several threads share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <mutex>

#include "base/parallel.h"
#include "rholm/context.h"

namespace rholm {

// Reports the part of `total` that is done, as a fraction between `from` and `to`, under `stage`.
// Throws Error{kCancelled} if the callback says so.
class SharedProgress {
 public:
  SharedProgress(const Context& context, const char* stage, double from, double to, double total)
      : context_(context), stage_(stage), from_(from), to_(to), total_(total) {}
  void add(std::size_t work) {
    if (!context_.progress) return;
    const std::lock_guard lock(mutex_);
    done_ += static_cast<double>(work);
    report_progress(context_, stage_, from_ + (to_ - from_) * std::min(1.0, done_ / total_));
  }

 private:
  const Context& context_;
  const char* stage_;
  double from_, to_, total_;
  std::mutex mutex_;
  double done_ = 0;
};

}  // namespace rholm
