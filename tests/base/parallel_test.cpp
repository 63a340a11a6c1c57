#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <new>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/chunks.h"
#include "base/compensated_sum.h"
#include "rholm/error.h"

namespace rholm {
namespace {

TEST(parallel_for, visits_every_index_once_for_any_number_of_threads) {
  for (const int threads : {1, 2, 4}) {
    for (const std::size_t n : {0u, 1u, 7u, 1000u}) {
      std::vector<std::atomic<int>> visits(n);
      parallel_for(n, 3, {.threads = threads}, {}, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& count : visits) EXPECT_EQ(count, 1);
    }
  }
}

TEST(run_limited, calls_on_this_thread_and_passes_on_what_is_thrown) {
  for (const int threads : {1, 2, 64}) {
    std::thread::id runner;
    EXPECT_THROW(run_limited(threads,
                             [&] {
                               runner = std::this_thread::get_id();
                               throw std::bad_alloc();
                             }),
                 std::bad_alloc);
    EXPECT_EQ(runner, std::this_thread::get_id());
  }
}

TEST(parallel_for, may_be_called_by_several_threads_at_once) {
  std::atomic<int> visits = 0;
  std::vector<std::thread> callers;
  callers.reserve(4);
  for (int caller = 0; caller < 4; ++caller) {
    callers.emplace_back([&] {
      for (int k = 0; k < 100; ++k) {
        parallel_for(16, 1, {.threads = 2}, {}, [&](std::size_t begin, std::size_t end) {
          visits += static_cast<int>(end - begin);
        });
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(visits, 4 * 100 * 16);
}

// Each caller is in its loop while all other callers are in their loops.
TEST(parallel_for, does_not_wait_for_loops_of_other_callers) {
  constexpr int kCallers = 8;
  std::atomic<int> in_loops = 0;
  std::atomic<bool> all = true;
  std::vector<std::jthread> callers;
  callers.reserve(kCallers);
  for (int caller = 0; caller < kCallers; ++caller) {
    callers.emplace_back([&] {
      const std::thread::id here = std::this_thread::get_id();
      std::atomic<bool> counted = false;
      parallel_for(2, 1, {.threads = 2}, {}, [&](std::size_t, std::size_t) {
        if (std::this_thread::get_id() != here || counted.exchange(true)) return;
        ++in_loops;
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (in_loops < kCallers && all) {
          std::this_thread::yield();
          if (std::chrono::steady_clock::now() > end) all = false;
        }
      });
      // The other thread may have run both chunks.
      if (!counted.exchange(true)) ++in_loops;
    });
  }
  callers.clear();
  EXPECT_TRUE(all);
}

// Returns the number of pages of the program that are in memory.
long resident_pages() {
  std::ifstream file("/proc/self/statm");
  long all = 0, resident = 0;
  file >> all >> resident;
  return resident;
}

TEST(parallel_for, many_calls_take_no_more_memory_than_few) {
  const auto call = [](int n) {
    for (int k = 0; k < n; ++k) {
      parallel_for(16, 1, {.threads = 2}, {}, [](std::size_t, std::size_t) {});
    }
  };
  call(100);
  const long before = resident_pages();
  ASSERT_GT(before, 0);
  call(2000);
  EXPECT_LT(resident_pages() - before, 1000);
}

TEST(parallel_for, callback_that_says_no_cancels) {
  for (const int threads : {1, 2}) {
    Context context{.threads = threads};
    context.progress = [](std::string_view, double fraction) { return fraction < 0.5; };
    std::atomic<int> chunks = 0;
    try {
      parallel_for(10000, 1, context, {.name = "test"},
                   [&](std::size_t, std::size_t) { ++chunks; });
      FAIL() << "not cancelled";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCancelled);
    }
    EXPECT_LT(chunks, 10000);
  }
}

TEST(parallel_for, progress_runs_from_and_to_the_ends_given) {
  Context context{.threads = 2};
  double last = 0;
  bool rises = true;
  context.progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "test");
    rises = rises && fraction > last;
    last = fraction;
    return true;
  };
  parallel_for(100, 1, context, {.name = "test", .from = 0.25, .to = 0.75},
               [](std::size_t, std::size_t) {});
  EXPECT_TRUE(rises);
  EXPECT_DOUBLE_EQ(last, 0.75);
}

TEST(parallel_for, exceptions_of_the_body_reach_the_caller) {
  EXPECT_THROW(parallel_for(100, 1, {.threads = 2}, {},
                            [](std::size_t begin, std::size_t) {
                              if (begin == 50) throw std::runtime_error("50");
                            }),
               std::runtime_error);
}

TEST(parallel_for, may_be_called_by_its_own_body) {
  for (const int threads : {1, 2, 4}) {
    std::vector<std::atomic<int>> visits(24 * 24);
    const Context context{.threads = threads};
    parallel_for(24, 5, context, {}, [&](std::size_t begin, std::size_t end) {
      parallel_for(24 * (end - begin), 7, context, {}, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) ++visits[24 * begin + i];
      });
    });
    for (const auto& count : visits) EXPECT_EQ(count, 1);
  }
}

TEST(parallel_for, exceptions_of_a_loop_in_its_body_reach_the_caller) {
  for (const int threads : {1, 2, 4}) {
    const Context context{.threads = threads};
    try {
      parallel_for(8, 1, context, {}, [&](std::size_t outer, std::size_t) {
        parallel_for(8, 1, context, {}, [&](std::size_t inner, std::size_t) {
          if (outer == 3 && inner == 5) throw std::runtime_error("3, 5");
        });
      });
      FAIL() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3, 5");
    }
  }
}

// Chunks that have not begun are left out. All of them together would take 20 s.
TEST(parallel_for, chunks_after_an_exception_are_left_out) {
  std::atomic<int> begun = 0;
  EXPECT_THROW(parallel_for(20000, 1, {.threads = 2}, {},
                            [&](std::size_t begin, std::size_t) {
                              ++begun;
                              if (begin == 0) throw std::runtime_error("0");
                              std::this_thread::sleep_for(std::chrono::milliseconds(1));
                            }),
               std::runtime_error);
  EXPECT_LT(begun, 20000);
}

TEST(compensated_sum, keeps_what_plain_addition_loses) {
  CompensatedSum sum;
  sum.add(1);
  for (int i = 0; i < 1000; ++i) sum.add(1e-17);
  sum.add(-1);
  EXPECT_NEAR(sum.value(), 1e-14, 1e-27);
}

}  // namespace
}  // namespace rholm
