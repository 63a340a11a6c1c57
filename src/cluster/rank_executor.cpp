#include "cluster/rank_executor.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <exception>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/bytes.h"
#include "cluster/collect.h"
#include "parts/part_threads.h"
#include "rholm/context.h"
#include "rholm/error.h"

namespace rholm {
namespace {

enum class Says : std::uint64_t { kMore, kResult };
enum class Gives : std::uint64_t { kWide, kNarrow, kNothing };

// The last byte of a result: the bytes in front of it are the result, or a message about bad input.
constexpr char kDone = 'd', kInvalid = 'i';

constexpr std::size_t kMostAtOnce = 64;  // chosen: a message is rare beside parts of 0.1 ms

std::string given(Gives what, std::size_t first = 0, std::size_t n = 0) {
  return ByteWriter().number(static_cast<std::uint64_t>(what)).number(first).number(n).take();
}

std::string result_of(const Executor::Work& work, std::size_t part, int threads) {
  try {
    return work(part, threads) + kDone;
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kInvalidInput) throw;
    return std::string(error.what()) + kInvalid;
  }
}

// Runs on every rank: computes the parts that rank 0 hands out, until no part is left.
void serve(Ranks& ranks, int threads, const Executor::Work& work) {
  const auto send = [&](Says what, std::uint64_t number, std::string_view text) {
    ByteWriter writer;
    writer.number(static_cast<std::uint64_t>(what)).number(number).text(text);
    ranks.send(0, Tag::kTask, writer.take());
  };
  const auto look = [&] {
    if (ranks.is_stopping()) throw Stopped();
  };
  const auto work_on = [&](std::size_t part, int n) {
    look();
    const CancelScope scope([&] { return ranks.keep_going(); });
    const RankAtWork at_work(ranks);
    try {
      send(Says::kResult, part, result_of(work, part, n));
    } catch (...) {
      ranks.fail(std::current_exception());
      throw;
    }
  };
  PartThreads crew(
      threads, [&](std::size_t part) { work_on(part, 1); }, look);
  // The next parts are asked for while half of the last ones are still in the queue.
  for (std::size_t last = 0;;) {
    crew.wait_for_queue(last / 2);
    send(Says::kMore, static_cast<std::uint64_t>(threads), {});
    const Packet packet = ranks.receive(Tag::kHand, 0);
    ByteReader bytes(packet.bytes);
    const auto what = static_cast<Gives>(bytes.number());
    const std::size_t first = bytes.number(), n = bytes.number();
    if (what == Gives::kNothing) break;
    if (what == Gives::kWide) {
      crew.wait_for_all();
      work_on(first, threads);
    } else {
      crew.add(first, n);
      last = n;
    }
  }
  crew.wait_for_all();
  look();
}

// The parts that are not handed out yet.
class HandOut {
 public:
  HandOut(const Parts& parts, const PartResults& results, int ranks)
      : parts_(parts), results_(results), ranks_(static_cast<std::size_t>(ranks)) {
    for (std::size_t rank = 0; rank < (parts.dealt ? ranks_ : 1); ++rank) {
      next_.push_back(first_of(rank));
    }
  }

  std::size_t handed_out() const { return handed_out_; }
  void stop() { stopped_ = true; }

  // Returns the answer to a rank that asks for parts, or nothing while the rank must wait.
  std::optional<std::string> some(int rank, std::size_t threads, std::size_t all_threads) {
    const std::size_t r = parts_.dealt ? static_cast<std::size_t>(rank) : 0;
    std::size_t& next = next_[r];
    const std::size_t left = (parts_.dealt ? first_of(r + 1) : parts_.count) - next;
    if (stopped_ || left == 0) return given(Gives::kNothing);
    // Dealt parts are handed out at once: all of their results may wait.
    if (!parts_.dealt && next >= results_.end_of_window(all_threads)) return std::nullopt;
    const bool is_wide = next < parts_.wide;
    const std::size_t n = is_wide || parts_.in_order ? 1 : share_of(left, threads, all_threads);
    handed_out_ += n;
    next += n;
    return given(is_wide ? Gives::kWide : Gives::kNarrow, next - n, n);
  }

 private:
  std::size_t first_of(std::size_t rank) const {
    return parts_.dealt ? rank * parts_.count / ranks_ : 0;
  }
  // Returns a share of the parts that are left: large in the beginning, single parts in the end.
  static std::size_t share_of(std::size_t left, std::size_t threads, std::size_t all_threads) {
    const std::size_t share = left * threads / (4 * all_threads);
    return std::min(left, std::clamp<std::size_t>(share, 1, kMostAtOnce * threads));
  }

  const Parts& parts_;
  const PartResults& results_;
  const std::size_t ranks_;
  std::vector<std::size_t> next_;
  std::size_t handed_out_ = 0;
  bool stopped_ = false;
};

// Runs on rank 0, until all results are taken and all ranks know that no part is left. Returns the
// message of the first part with invalid input, in the order in which results are taken.
std::optional<std::string> hand_out(Ranks& ranks, const Parts& parts, const Executor::Take& take) {
  std::optional<std::string> fault;
  const Executor::Take take_valid = [&](std::size_t part, std::string bytes) {
    const char end = bytes.back();
    bytes.pop_back();
    if (fault) return;
    if (end == kDone) return take(part, std::move(bytes));
    fault = std::move(bytes);
  };
  PartResults results(parts, take_valid);
  HandOut left(parts, results, ranks.size());
  std::vector<std::size_t> threads_of(static_cast<std::size_t>(ranks.size()), 1);
  std::size_t all_threads = threads_of.size(), came = 0, to_dismiss = threads_of.size();
  std::deque<int> asking;
  while (to_dismiss > 0 || came < left.handed_out()) {
    Packet packet = ranks.receive(Tag::kTask);
    ByteReader bytes(packet.bytes);
    const auto what = static_cast<Says>(bytes.number());
    const std::size_t number = bytes.number();
    if (what == Says::kMore) {
      std::size_t& threads = threads_of[static_cast<std::size_t>(packet.from)];
      all_threads += number - threads;
      threads = number;
      asking.push_back(packet.from);
    } else {
      ++came;
      results.put(number, std::string(bytes.text()));
      if (fault) left.stop();
    }
    std::erase_if(asking, [&](int rank) {
      std::optional<std::string> answer =
          left.some(rank, threads_of[static_cast<std::size_t>(rank)], all_threads);
      if (!answer) return false;
      if (*answer == given(Gives::kNothing)) --to_dismiss;
      ranks.send(rank, Tag::kHand, std::move(*answer));
      return true;
    });
  }
  return fault;
}

}  // namespace

RankExecutor::RankExecutor(Ranks& ranks, int threads, std::function<void(const Parts&)> call)
    : ranks_(ranks), threads_(threads > 0 ? threads : ranks.processors()), call_(std::move(call)) {}

void RankExecutor::run(const Parts& parts, const Work& work, const Take& take) {
  std::optional<std::string> fault;
  if (ranks_.rank() == 0) {
    if (call_) call_(parts);
    // Rank 0 asks itself for parts, in the same way as the other ranks ask it.
    std::jthread own([&] {
      try {
        serve(ranks_, threads_, work);
      } catch (...) {
        ranks_.fail(std::current_exception());
      }
    });
    try {
      fault = hand_out(ranks_, parts, take);
    } catch (...) {
      ranks_.fail(std::current_exception());  // called before waiting for rank 0's own parts
      throw;
    }
  } else {
    serve(ranks_, threads_, work);
  }
  barrier(ranks_);
  if (fault) throw Error(ErrorCode::kInvalidInput, *fault);
}

void RankExecutor::once(const std::function<void()>& body) {
  barrier(ranks_);
  if (ranks_.rank() == 0) {
    const RankAtWork at_work(ranks_);
    body();
  }
  barrier(ranks_);
}

}  // namespace rholm
