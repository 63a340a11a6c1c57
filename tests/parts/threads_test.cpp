#include "parts/threads.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <numeric>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/cancel.h"
#include "rholm/context.h"
#include "rholm/error.h"

namespace rholm {
namespace {

using namespace std::chrono_literals;

constexpr int kThreads[] = {1, 2, 3, 8};

// Every tenth part takes longer, so that other parts overtake it.
std::string slow_now_and_then(std::size_t part, int) {
  if (part % 10 == 3) std::this_thread::sleep_for(3ms);
  return std::to_string(part);
}

TEST(threads, work_each_part_once_and_take_in_order) {
  for (const int n : kThreads) {
    for (const std::size_t count : {0u, 1u, 2u, 100u}) {
      const std::thread::id caller = std::this_thread::get_id();
      std::vector<std::size_t> taken;
      Threads(n).run({.count = count}, slow_now_and_then,
                     [&](std::size_t part, const std::string& bytes) {
                       EXPECT_EQ(std::this_thread::get_id(), caller);
                       EXPECT_EQ(bytes, std::to_string(part));
                       taken.push_back(part);
                     });
      std::vector<std::size_t> wanted(count);
      std::iota(wanted.begin(), wanted.end(), 0);
      EXPECT_EQ(taken, wanted);
    }
  }
}

TEST(threads, take_results_as_they_come) {
  for (const int n : kThreads) {
    std::multiset<std::size_t> taken;
    Threads(n).run({.count = 100, .in_order = false}, slow_now_and_then,
                   [&](std::size_t part, const std::string&) { taken.insert(part); });
    EXPECT_EQ(taken.size(), 100u);
    EXPECT_EQ(std::set<std::size_t>(taken.begin(), taken.end()).size(), 100u);
  }
  // The first part waits for the second one to be taken.
  std::atomic<bool> is_taken = false;
  Threads(2).run(
      {.count = 2, .in_order = false},
      [&](std::size_t part, int) {
        while (part == 0 && !is_taken) std::this_thread::sleep_for(1ms);
        return std::string();
      },
      [&](std::size_t part, const std::string&) { is_taken = is_taken || part == 1; });
  EXPECT_TRUE(is_taken);
}

TEST(threads, begin_no_part_far_ahead_of_those_taken) {
  for (const int n : kThreads) {
    std::atomic<std::size_t> n_taken = 0;
    Threads(n).run(
        {.count = 60},
        [&](std::size_t part, int threads) {
          EXPECT_LT(part, n_taken + 2 * static_cast<std::size_t>(n));
          return slow_now_and_then(part, threads);
        },
        [&](std::size_t, const std::string&) { ++n_taken; });
    EXPECT_EQ(n_taken, 60u);
  }
}

TEST(threads, give_wide_parts_all_threads_one_at_a_time) {
  for (const int n : kThreads) {
    std::atomic<int> at_work = 0;
    std::atomic<std::size_t> n_wide = 0;
    Threads(n).run(
        {.count = 40, .wide = 5, .in_order = false},
        [&](std::size_t part, int threads) {
          const int others = at_work++;
          EXPECT_EQ(threads, part < 5 ? n : 1);
          if (part < 5) {
            EXPECT_EQ(others, 0);
            EXPECT_EQ(n_wide++, part);
          } else {
            EXPECT_EQ(n_wide, 5u);
          }
          std::this_thread::sleep_for(1ms);
          --at_work;
          return std::string();
        },
        [](std::size_t, const std::string&) {});
    EXPECT_EQ(n_wide, 5u);
  }
}

TEST(threads, work_several_parts_at_a_time) {
  std::atomic<int> there = 0;
  Threads(3).run(
      {.count = 3},
      [&](std::size_t, int) {
        ++there;
        while (there < 3) std::this_thread::sleep_for(1ms);  // one thread alone would wait for ever
        return std::string();
      },
      [](std::size_t, const std::string&) {});
  EXPECT_EQ(there, 3);
}

TEST(threads, throw_what_a_part_throws_and_begin_no_others) {
  for (const int n : kThreads) {
    for (const std::size_t wide : {0u, 30u}) {
      std::atomic<std::size_t> n_begun = 0, n_taken = 0;
      try {
        Threads(n).run(
            {.count = 1000, .wide = wide},
            [&](std::size_t part, int) {
              ++n_begun;
              if (part == 20) throw Error(ErrorCode::kInvalidInput, "a bad part");
              ask_cancel();
              return std::string();
            },
            [&](std::size_t part, const std::string&) {
              EXPECT_EQ(part, n_taken++);
              EXPECT_LT(part, 20u);
            });
        FAIL() << "nothing was thrown";
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
        EXPECT_STREQ(error.what(), "a bad part");
      }
      EXPECT_LE(n_begun, 20u + 2 * static_cast<std::size_t>(n));
    }
  }
}

TEST(threads, throw_what_take_throws) {
  for (const int n : kThreads) {
    std::atomic<int> at_work = 0;
    EXPECT_THROW(Threads(n).run(
                     {.count = 1000},
                     [&](std::size_t part, int) {
                       ++at_work;
                       // Parts that run at the same time are told to end.
                       for (int i = 0; part > 5 && i < 10000; ++i) {
                         try {
                           ask_cancel();
                         } catch (...) {
                           --at_work;
                           throw;
                         }
                         std::this_thread::sleep_for(1ms);
                       }
                       --at_work;
                       return std::string();
                     },
                     [&](std::size_t part, const std::string&) {
                       if (part == 5) throw Error(ErrorCode::kIo, "the disk is full");
                     }),
                 Error);
    EXPECT_EQ(at_work, 0);  // no part still runs
  }
}

TEST(threads, are_cancelled_by_the_scope_of_the_caller) {
  for (const int n : kThreads) {
    std::atomic<bool> go_on = true;
    const CancelScope scope([&] { return go_on.load(); });
    std::atomic<std::size_t> n_begun = 0;
    try {
      Threads(n).run(
          {.count = 100000},
          [&](std::size_t part, int) {
            ++n_begun;
            if (part == 10) go_on = false;
            while (!go_on) {
              ask_cancel();  // ends the part also on threads with another scope
              std::this_thread::sleep_for(1ms);
            }
            return std::string();
          },
          [](std::size_t, const std::string&) {});
      FAIL() << "it was not cancelled";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCancelled);
    }
    EXPECT_LT(n_begun, 100u);
  }
}

TEST(threads, run_parts_within_parts) {
  for (const int n : kThreads) {
    std::size_t sum = 0;
    Threads(n).run(
        {.count = 10},
        [&](std::size_t part, int) {
          std::size_t of_part = 0;
          Threads(2).run({.count = 10}, slow_now_and_then,
                         [&](std::size_t, const std::string& bytes) { of_part += bytes.size(); });
          return std::to_string(part * of_part);
        },
        [&](std::size_t, const std::string& bytes) { sum += std::stoul(bytes); });
    EXPECT_EQ(sum, 450u);
  }
}

TEST(threads, do_once_what_is_for_one_process) {
  Threads alone(3);
  EXPECT_FALSE(alone.is_shared());
  int n = 0;
  alone.once([&] { ++n; });
  EXPECT_EQ(n, 1);
}

}  // namespace
}  // namespace rholm
