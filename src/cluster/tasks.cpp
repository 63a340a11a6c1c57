#include "cluster/tasks.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <optional>
#include <span>
#include <thread>

#include "cluster/pack.h"

namespace rholm {
namespace {

using namespace std::chrono_literals;

enum class Asks : std::uint64_t { kForMore, kTake };
enum class Gives : std::uint64_t { kWide, kNarrow, kNothing };

constexpr std::size_t kMostAtOnce = 64;  // chosen: a message is rare beside tasks of 0.1 ms

// The threads of a rank, and what they have to do.
class Crew {
 public:
  Crew(Ranks& ranks, int threads, const DoTask& work)
      : ranks_(ranks), threads_(threads), work_(work) {}

  void run() {
    {
      std::vector<std::jthread> threads;
      threads.reserve(static_cast<std::size_t>(threads_));
      for (int i = 0; i < threads_; ++i) threads.emplace_back([this] { work_on(); });
      guarded([this] { fetch(); });
      end();
    }
    if (failure_) std::rethrow_exception(failure_);
    if (ranks_.is_stopping()) throw Stopped();
  }

 private:
  // The next tasks are asked for while half of the last ones are still there.
  void fetch() {
    for (;;) {
      wait_until([this] { return queue_.size() <= last_ / 2; });
      ranks_.send(0, Tag::kTask,
                  Packer()
                      .number(static_cast<std::uint64_t>(Asks::kForMore))
                      .number(static_cast<std::uint64_t>(threads_))
                      .take());
      const Packet packet = ranks_.receive(Tag::kHand, 0);
      Unpacker bytes(packet.bytes);
      switch (static_cast<Gives>(bytes.number())) {
        case Gives::kNothing:
          return;
        case Gives::kWide:
          wait_until([this] { return queue_.empty() && busy_ == 0; });
          one(bytes.number(), threads_);
          break;
        case Gives::kNarrow: {
          const std::lock_guard lock(mutex_);
          last_ = bytes.number();
          for (std::size_t i = 0; i < last_; ++i) queue_.push_back(bytes.number());
          changed_.notify_all();
        }
      }
    }
  }

  void work_on() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return ended_ || failure_ || !queue_.empty(); });
      if (failure_ || queue_.empty()) return;
      const std::uint64_t task = queue_.front();
      queue_.pop_front();
      ++busy_;
      lock.unlock();
      guarded([&] { one(task, 1); });
      lock.lock();
      --busy_;
      changed_.notify_all();
    }
  }

  void one(std::uint64_t task, int threads) {
    if (ranks_.is_stopping()) throw Stopped();
    std::string result;
    {
      const AtWork at_work(ranks_);
      result = work_(task, threads);
    }
    ranks_.send(
        0, Tag::kTask,
        Packer().number(static_cast<std::uint64_t>(Asks::kTake)).number(task).text(result).take());
  }

  // The first failure counts, and nothing is begun after it.
  void guarded(const std::function<void()>& action) {
    try {
      action();
    } catch (...) {
      ranks_.fail(std::current_exception());
      const std::lock_guard lock(mutex_);
      if (!failure_) failure_ = std::current_exception();
      changed_.notify_all();
    }
  }

  template <typename Condition>
  void wait_until(const Condition& condition) {
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, 50ms, [&] { return failure_ || condition(); })) {
      if (ranks_.is_stopping()) throw Stopped();
    }
    if (failure_) throw Stopped();
  }

  void end() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }

  Ranks& ranks_;
  const int threads_;
  const DoTask& work_;
  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::deque<std::uint64_t> queue_;
  std::size_t last_ = 0;  // how many came at once
  int busy_ = 0;
  bool ended_ = false;
  std::exception_ptr failure_;
};

// What is not handed out yet.
class Store {
 public:
  explicit Store(const TaskList& tasks) : wide_(tasks.wide), narrow_(tasks.narrow) {}

  // A share of what is left: large in the beginning, single ones in the end.
  std::string some(std::uint64_t threads, std::uint64_t all_threads) {
    if (!wide_.empty()) {
      const std::uint64_t task = wide_.front();
      wide_ = wide_.subspan(1);
      return Packer().number(static_cast<std::uint64_t>(Gives::kWide)).number(task).take();
    }
    if (narrow_.empty()) return Packer().number(static_cast<std::uint64_t>(Gives::kNothing)).take();
    const std::size_t share = narrow_.size() * threads / (4 * all_threads);
    const std::size_t n = std::clamp<std::size_t>(share, 1, kMostAtOnce * threads);
    Packer bytes;
    bytes.number(static_cast<std::uint64_t>(Gives::kNarrow)).number(std::min(n, narrow_.size()));
    for (const std::uint64_t task : narrow_.first(std::min(n, narrow_.size()))) bytes.number(task);
    narrow_ = narrow_.subspan(std::min(n, narrow_.size()));
    return bytes.take();
  }

 private:
  std::span<const std::uint64_t> wide_, narrow_;
};

void hand_out(Ranks& ranks, const TaskList& tasks, const TakeResult& take) {
  Store store(tasks);
  std::vector<std::uint64_t> threads_of(static_cast<std::size_t>(ranks.size()), 1);
  std::size_t left = tasks.wide.size() + tasks.narrow.size();
  std::size_t to_dismiss = static_cast<std::size_t>(ranks.size());  // ranks that know of no end
  while (left > 0 || to_dismiss > 0) {
    const Packet packet = ranks.receive(Tag::kTask);
    Unpacker bytes(packet.bytes);
    if (static_cast<Asks>(bytes.number()) == Asks::kTake) {
      const std::uint64_t task = bytes.number();
      take(task, std::string(bytes.text()));
      --left;
      continue;
    }
    auto& asking = threads_of[static_cast<std::size_t>(packet.from)];
    asking = bytes.number();
    std::uint64_t all = 0;
    for (const std::uint64_t n : threads_of) all += n;
    std::string given = store.some(asking, all);
    if (Unpacker(given).number() == static_cast<std::uint64_t>(Gives::kNothing)) --to_dismiss;
    ranks.send(packet.from, Tag::kHand, std::move(given));
  }
}

// Tasks that are handed out one at a time, and their results in order.
class OrderedStore {
 public:
  OrderedStore(const OrderedTasks& tasks, const Ranks& ranks)
      : tasks_(tasks), ranks_(static_cast<std::uint64_t>(ranks.size())) {
    for (std::uint64_t rank = 0; rank < ranks_; ++rank) next_of_.push_back(first_of(rank));
  }

  bool has_ended() const { return taken_ == (stopped_ ? handed_out_ : tasks_.count); }

  void put(std::uint64_t task, std::string bytes, const TakeNext& take) {
    results_.emplace(task, std::move(bytes));
    auto next = results_.begin();
    while (!stopped_ && next != results_.end() && next->first == taken_) {
      stopped_ = !take(next->first, next->second);
      next = results_.erase(next);
      ++taken_;
    }
    if (!stopped_) return;
    taken_ += results_.size();  // what is still under way is not wanted
    results_.clear();
  }

  // What a rank gets that asks, if anything is to be said now; as many may be done or wait as
  // there are threads twice.
  std::optional<std::string> some(int rank, std::uint64_t all_threads) {
    std::uint64_t& next = tasks_.dealt ? next_of_[static_cast<std::size_t>(rank)] : next_of_[0];
    const std::uint64_t end =
        tasks_.dealt ? first_of(static_cast<std::uint64_t>(rank) + 1) : tasks_.count;
    if (stopped_ || next == end) {
      return Packer().number(static_cast<std::uint64_t>(Gives::kNothing)).take();
    }
    if (!tasks_.dealt && next >= taken_ + 2 * all_threads) return std::nullopt;
    ++handed_out_;
    return Packer()
        .number(static_cast<std::uint64_t>(Gives::kNarrow))
        .number(1)
        .number(next++)
        .take();
  }

 private:
  std::uint64_t first_of(std::uint64_t rank) const {
    return tasks_.dealt ? rank * tasks_.count / ranks_ : 0;
  }
  const OrderedTasks& tasks_;
  const std::uint64_t ranks_;
  std::vector<std::uint64_t> next_of_;
  std::uint64_t handed_out_ = 0, taken_ = 0;
  bool stopped_ = false;
  std::map<std::uint64_t, std::string> results_;
};

void hand_out(Ranks& ranks, const OrderedTasks& tasks, const TakeNext& take) {
  OrderedStore store(tasks, ranks);
  std::vector<std::uint64_t> threads_of(static_cast<std::size_t>(ranks.size()), 1);
  std::size_t to_dismiss = static_cast<std::size_t>(ranks.size());
  std::deque<int> asking;
  while (!store.has_ended() || to_dismiss > 0) {
    Packet packet = ranks.receive(Tag::kTask);
    Unpacker bytes(packet.bytes);
    if (static_cast<Asks>(bytes.number()) == Asks::kTake) {
      const std::uint64_t task = bytes.number();
      store.put(task, std::string(bytes.text()), take);
    } else {
      threads_of[static_cast<std::size_t>(packet.from)] = bytes.number();
      asking.push_back(packet.from);
    }
    std::uint64_t all = 0;
    for (const std::uint64_t n : threads_of) all += n;
    std::erase_if(asking, [&](int rank) {
      std::optional<std::string> given = store.some(rank, all);
      if (!given) return false;
      if (Unpacker(*given).number() == static_cast<std::uint64_t>(Gives::kNothing)) --to_dismiss;
      ranks.send(rank, Tag::kHand, std::move(*given));
      return true;
    });
  }
}

// Rank 0 asks itself, as the others ask it, while `hand_out` answers.
void lead(Ranks& ranks, int threads, const DoTask& work, const std::function<void()>& hand_out) {
  std::jthread own([&] {
    try {
      serve_tasks(ranks, threads, work);
    } catch (...) {
      ranks.fail(std::current_exception());
    }
  });
  try {
    hand_out();
  } catch (...) {
    ranks.fail(std::current_exception());  // before its own tasks are waited for
    throw;
  }
}

}  // namespace

void serve_tasks(Ranks& ranks, int threads, const DoTask& work) {
  Crew(ranks, threads, work).run();
}

void lead_tasks(Ranks& ranks, const TaskList& tasks, int threads, const DoTask& work,
                const TakeResult& take) {
  lead(ranks, threads, work, [&] { hand_out(ranks, tasks, take); });
}

void lead_tasks(Ranks& ranks, const OrderedTasks& tasks, int threads, const DoTask& work,
                const TakeNext& take) {
  lead(ranks, threads, work, [&] { hand_out(ranks, tasks, take); });
}

}  // namespace rholm
