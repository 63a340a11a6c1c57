#include "base/progress.h"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "rholm/error.h"

namespace rholm {
namespace {

TEST(shared_progress, of_several_threads_rises_to_its_end_and_not_beyond) {
  std::vector<double> seen;
  const Context context{.progress = [&](std::string_view stage, double fraction) {
    EXPECT_EQ(stage, "work");
    seen.push_back(fraction);
    return true;
  }};
  SharedProgress progress(context, "work", 0.25, 0.75, 100);
  std::vector<std::thread> threads;
  threads.reserve(4);
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      for (int k = 0; k < 30; ++k) progress.add(1);
    });
  }
  for (std::thread& thread : threads) thread.join();
  ASSERT_EQ(seen.size(), 120u);
  for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_GE(seen[i], seen[i - 1]);
  EXPECT_DOUBLE_EQ(seen.front(), 0.255);
  EXPECT_EQ(seen.back(), 0.75);
}

TEST(shared_progress, throws_where_the_callback_says_so) {
  const Context context{.progress = [](std::string_view, double) { return false; }};
  SharedProgress progress(context, "work", 0, 1, 10);
  try {
    progress.add(1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
}

}  // namespace
}  // namespace rholm
