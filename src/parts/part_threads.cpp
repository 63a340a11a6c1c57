#include "parts/part_threads.h"

#include <system_error>
#include <utility>

namespace rholm {

PartThreads::PartThreads(int threads, std::function<void(std::size_t)> work,
                         std::function<void()> meanwhile)
    : work_(std::move(work)), meanwhile_(std::move(meanwhile)) {
  threads_.reserve(static_cast<std::size_t>(threads));
  try {
    for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { work_on(); });
  } catch (const std::system_error&) {
    if (threads_.empty()) throw;  // else the existing threads compute all parts
  }
}

PartThreads::~PartThreads() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  threads_.clear();
}

void PartThreads::add(std::size_t first, std::size_t n) {
  const std::lock_guard lock(mutex_);
  for (std::size_t part = first; part < first + n; ++part) queue_.push_back(part);
  changed_.notify_all();
}

void PartThreads::work_on() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return ended_ || failure_ || !queue_.empty(); });
    if (ended_ || failure_) return;
    const std::size_t part = queue_.front();
    queue_.pop_front();
    ++busy_;
    lock.unlock();
    std::exception_ptr failure;
    try {
      work_(part);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    --busy_;
    if (!failure_) failure_ = std::move(failure);
    changed_.notify_all();
  }
}

void PartResults::put(std::size_t part, std::string bytes) {
  if (!parts_.in_order) {
    take_(part, std::move(bytes));
    ++taken_;
    return;
  }
  waiting_.emplace(part, std::move(bytes));
  for (auto next = waiting_.begin(); next != waiting_.end() && next->first == taken_;
       next = waiting_.erase(next), ++taken_) {
    take_(next->first, std::move(next->second));
  }
}

}  // namespace rholm
