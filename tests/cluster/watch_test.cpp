#include "cluster/watch.h"

#include <gtest/gtest.h>

namespace rholm {
namespace {

constexpr double kPatience = 10;

TEST(watch, finds_who_is_silent_but_not_itself) {
  Watch watch(3, 0);
  EXPECT_FALSE(watch.look(10, kPatience, 0));
  watch.heard(1, 9);
  const auto found = watch.look(10.1, kPatience, 0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->rank, 2);
  EXPECT_EQ(found->why, Watch::Why::kSilent);
  EXPECT_FALSE(watch.look(10.1, kPatience, 0, 1));
}

TEST(watch, finds_work_without_progress) {
  Watch watch(2, 0);
  for (int second = 1; second <= 10; ++second) {
    watch.pulse(1, {.is_working = true, .progress = 7}, second);
    EXPECT_FALSE(watch.look(second, kPatience, 0));
  }
  watch.pulse(1, {.is_working = true, .progress = 7}, 12);
  const auto found = watch.look(12, kPatience, 0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->rank, 1);
  EXPECT_EQ(found->why, Watch::Why::kNoProgress);
}

// A result after the last pulse shows that the rank is alive, but not that its work makes progress.
TEST(watch, calls_silent_who_was_heard_after_its_last_pulse) {
  Watch watch(2, 0);
  watch.pulse(1, {.is_working = true, .progress = 7}, 1);
  watch.heard(1, 1.5);
  EXPECT_FALSE(watch.look(11.4, kPatience, 0));
  const auto found = watch.look(11.6, kPatience, 0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->why, Watch::Why::kSilent);
}

TEST(watch, lets_work_take_as_long_as_it_gets_on) {
  Watch watch(2, 0);
  for (int second = 1; second <= 100; ++second) {
    watch.pulse(1, {.is_working = true, .progress = static_cast<std::uint64_t>(second / 9)},
                second);
    EXPECT_FALSE(watch.look(second, kPatience, 0)) << second;
  }
}

// Rank 0 works too, so that a failure of its own is found as well.
TEST(watch, lets_who_has_nothing_to_do_wait) {
  Watch watch(2, 0);
  for (int second = 1; second <= 100; ++second) {
    watch.pulse(0, {.is_working = second > 50, .progress = 7}, second);
    watch.heard(1, second);
    EXPECT_EQ(watch.look(second, kPatience, 0).has_value(), second > 61) << second;
  }
}

// After sleep of the machine, rank 0 has not seen what the others did in the meantime.
TEST(watch, forgives_what_it_has_not_seen) {
  Watch watch(2, 0);
  watch.pulse(1, {.is_working = true, .progress = 7}, 1);
  watch.forgive(1000);
  EXPECT_FALSE(watch.look(1005, kPatience, 0));
  EXPECT_TRUE(watch.look(1011, kPatience, 0));
}

}  // namespace
}  // namespace rholm
