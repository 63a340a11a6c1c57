// Deliberate races, each in a process of its own. They show that ThreadSanitizer finds races in
// loops of the library, so that its silence has a meaning. Built with ThreadSanitizer only.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string_view>
#include <thread>
#include <vector>

#include "base/parallel.h"

namespace rholm {
namespace {

constexpr std::size_t kN = 64;
constexpr int kReported = 66;  // exit code of ThreadSanitizer after a race

// Calls run() and exits; ThreadSanitizer makes the exit code 66 if it saw a race.
[[noreturn]] void leave_after(const std::function<void()>& run) {
  run();
  std::exit(0);
}

Context with_progress(int threads) {
  Context context{.threads = threads};
  context.progress = [](std::string_view, double) { return true; };
  return context;
}

class Race : public testing::Test {
 protected:
  void SetUp() override { testing::FLAGS_gtest_death_test_style = "threadsafe"; }
};

TEST_F(Race, of_chunks_that_add_to_one_number_is_reported) {
  double sum = 0;
  const auto add = [&](std::size_t begin, std::size_t) { sum += static_cast<double>(begin); };
  EXPECT_EXIT(leave_after([&] { parallel_for(kN, 1, {.threads = 2}, {}, add); }),
              testing::ExitedWithCode(kReported), "data race");
  EXPECT_EXIT(leave_after([&] { parallel_for(2, 1, {}, {}, add); }),
              testing::ExitedWithCode(kReported), "data race");
}

// The lock around progress puts many chunks in an order, but not all of them.
TEST_F(Race, is_reported_with_progress_as_well) {
  double sum = 0;
  const auto add = [&](std::size_t begin, std::size_t) { sum += static_cast<double>(begin); };
  EXPECT_EXIT(leave_after([&] { parallel_for(kN, 1, with_progress(2), {"sum"}, add); }),
              testing::ExitedWithCode(kReported), "data race");
}

TEST_F(Race, of_a_chunk_that_reads_what_its_neighbour_writes_is_reported) {
  std::vector<float> values(kN + 1);
  const auto smooth = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) values[i] += values[i + 1];
  };
  EXPECT_EXIT(leave_after([&] { parallel_for(kN, 16, {.threads = 2}, {}, smooth); }),
              testing::ExitedWithCode(kReported), "data race");
}

// All chunks write the same value, so that no comparison of results would find the race.
TEST_F(Race, of_chunks_that_write_the_same_value_is_reported) {
  bool any = false;
  const auto note = [&](std::size_t, std::size_t) { any = true; };
  EXPECT_EXIT(leave_after([&] { parallel_for(kN, 1, {.threads = 2}, {}, note); }),
              testing::ExitedWithCode(kReported), "data race");
}

TEST_F(Race, of_bits_in_one_word_is_reported) {
  std::vector<bool> bits(kN);
  const auto set = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) bits[i] = true;
  };
  EXPECT_EXIT(leave_after([&] { parallel_for(kN, 8, {.threads = 2}, {}, set); }),
              testing::ExitedWithCode(kReported), "data race");
}

TEST_F(Race, in_a_loop_within_a_loop_is_reported) {
  std::array<double, 4> sums{};
  const auto outer = [&](std::size_t k, std::size_t) {
    parallel_for(kN, 1, {.threads = 2}, {},
                 [&](std::size_t begin, std::size_t) { sums.at(k) += static_cast<double>(begin); });
  };
  EXPECT_EXIT(leave_after([&] { parallel_for(sums.size(), 1, {.threads = 2}, {}, outer); }),
              testing::ExitedWithCode(kReported), "data race");
}

// Neither loops within chunks nor their records (RHOLM_LOOPS) put the chunks in an order.
TEST_F(Race, of_chunks_before_and_after_loops_of_their_own_is_reported) {
  int calls = 0;
  const auto outer = [&](std::size_t k, std::size_t) {
    if (k == 0) ++calls;
    if (k == 1) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    parallel_for(kN, 1, {.threads = 2}, {}, [](std::size_t, std::size_t) {});
    if (k == 1) ++calls;
  };
  EXPECT_EXIT(leave_after([&] { parallel_for(2, 1, {.threads = 2}, {}, outer); }),
              testing::ExitedWithCode(kReported), "data race");
}

// A loop waits for its chunks: values that they wrote may be read after the loop.
TEST_F(Race, of_loops_one_after_another_there_is_none) {
  const auto sound = [] {
    std::vector<double> values(kN), sums(kN / 4);
    const Context context = with_progress(3);
    parallel_for(kN, 4, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) values[i] = static_cast<double>(i);
    });
    parallel_for(sums.size(), 1, context, {}, [&](std::size_t k, std::size_t) {
      std::array<double, 4> mirrored{};
      parallel_for(4, 1, context, {}, [&](std::size_t i, std::size_t) {
        mirrored.at(i) = values[kN - 1 - 4 * k - i];
      });
      for (const double value : mirrored) sums[k] += value;
    });
    double sum = 0;
    for (const double part : sums) sum += part;
    if (2 * sum != kN * (kN - 1)) std::exit(1);
  };
  EXPECT_EXIT(leave_after(sound), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace rholm
