#include "base/cancel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/parallel.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Number of polls after which any CancelPoll has asked.
constexpr int kMany = 1 << 20;

bool is_cancelled(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
    return true;
  }
  return false;
}

void poll_many_times() {
  CancelPoll poll;
  for (int i = 0; i < kMany; ++i) poll();
}

TEST(CancelScope, ends_loops_that_ask) {
  EXPECT_FALSE(is_cancelled(poll_many_times));
  {
    int asked = 0;
    const CancelScope scope([&] { return ++asked < 3; });
    EXPECT_TRUE(is_cancelled(poll_many_times));
    EXPECT_EQ(asked, 3);
    EXPECT_TRUE(is_cancelled(ask_cancel));
  }
  EXPECT_FALSE(is_cancelled(poll_many_times));
  EXPECT_FALSE(is_cancelled(ask_cancel));
}

TEST(CancelScope, within_another_counts_until_it_ends) {
  const CancelScope outer([] { return false; });
  {
    const CancelScope inner([] { return true; });
    EXPECT_FALSE(is_cancelled(poll_many_times));
  }
  EXPECT_TRUE(is_cancelled(poll_many_times));
}

TEST(CancelScope, is_of_one_thread) {
  const CancelScope scope([] { return false; });
  bool cancelled = true;
  std::thread([&] { cancelled = is_cancelled(poll_many_times); }).join();
  EXPECT_FALSE(cancelled);
}

// A loop without progress ends, and only the calling thread asks.
TEST(CancelScope, ends_loops_on_several_threads) {
  const std::thread::id here = std::this_thread::get_id();
  std::atomic<int> elsewhere = 0;
  for (const int threads : {1, 2, 4}) {
    std::atomic<int> chunks = 0;
    const CancelScope scope([&] {
      elsewhere += std::this_thread::get_id() != here;
      return chunks < 50;
    });
    EXPECT_TRUE(is_cancelled([&] {
      parallel_for(100'000, 1, {.threads = threads}, {}, [&](std::size_t, std::size_t) {
        poll_many_times();
        ++chunks;
      });
    }));
    EXPECT_LT(chunks, 100'000);
  }
  EXPECT_EQ(elsewhere, 0);
}

// The caller is done with its own chunk; the other chunk runs until the question is answered.
TEST(CancelScope, is_asked_by_a_caller_that_waits_for_others) {
  const std::thread::id here = std::this_thread::get_id();
  std::atomic<bool> other_began = false, stop = false;
  std::atomic<int> refusals = 0;
  const CancelScope scope([&] {
    refusals += stop;
    return !stop;
  });
  EXPECT_TRUE(is_cancelled([&] {
    parallel_for(2, 1, {.threads = 2}, {}, [&](std::size_t, std::size_t) {
      if (std::this_thread::get_id() == here) {
        while (!other_began) std::this_thread::yield();
        return;
      }
      other_began = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(50));  // the caller is done by now
      stop = true;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));  // several intervals of the wait
      for (;;) poll_many_times();
    });
  }));
  EXPECT_EQ(refusals, 1);  // after a refusal the scope is not asked again
}

// An exception of one thread ends the chunks of all others, and the caller receives it.
TEST(CancelScope, of_a_loop_ends_with_its_first_exception) {
  std::atomic<int> begun = 0;
  try {
    parallel_for(2, 1, {.threads = 2}, {}, [&](std::size_t begin, std::size_t) {
      ++begun;
      while (begun < 2) std::this_thread::yield();
      if (begin == 0) throw std::runtime_error("0");
      for (;;) poll_many_times();
    });
    FAIL() << "nothing thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "0");
  }
}

// Loops of several callers share waiting threads: no loop may be ended by the scope of another.
TEST(CancelScope, does_not_end_loops_of_other_threads) {
  std::atomic<bool> go_on = true;
  std::thread cancelled([&] {
    while (go_on) {
      const CancelScope scope([] { return false; });
      EXPECT_TRUE(is_cancelled([] {
        parallel_for(64, 1, {.threads = 2}, {},
                     [](std::size_t, std::size_t) { poll_many_times(); });
      }));
    }
  });
  for (int k = 0; k < 20; ++k) {
    EXPECT_FALSE(is_cancelled([] {
      parallel_for(16, 1, {.threads = 2}, {}, [](std::size_t, std::size_t) { poll_many_times(); });
    }));
  }
  go_on = false;
  cancelled.join();
}

}  // namespace
}  // namespace rholm
