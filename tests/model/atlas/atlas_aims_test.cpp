// The search for an aim, on made-up outcomes.
#include "model/atlas/atlas_fit.h"

#include <gtest/gtest.h>

namespace rholm {
namespace {

constexpr double kTolerance = 2;

AimOutcome outcome(double aim, double rms, std::size_t numbers, bool whole = true) {
  return {.reached = aim, .rms = rms, .numbers = numbers, .met = rms <= kTolerance, .whole = whole};
}

TEST(aims, a_factor_is_found_at_once) {
  Aims aims(kTolerance, kTolerance);
  ASSERT_TRUE(aims.advance(outcome(aims.aim(), 1.6 * aims.aim(), 100)));
  const double rms = 1.6 * aims.aim();
  EXPECT_LE(rms, kTolerance);
  EXPECT_TRUE(aims.is_close(rms));
}

// rms = 0.3 aim^1.5 reaches 2 at aim = (2 / 0.3)^(2/3); numbers fall as 1 / aim.
TEST(aims, a_power_is_halved_until_the_aims_are_the_same) {
  Aims aims(kTolerance, kTolerance);
  const double right = std::pow(kTolerance / 0.3, 2.0 / 3);
  int tries = 0;
  bool goes_on = true;
  double best = 0;
  while (goes_on && tries < 20) {
    const double aim = aims.aim(), rms = 0.3 * std::pow(aim, 1.5);
    if (rms <= kTolerance) best = std::max(best, aim);
    if (rms <= kTolerance && aims.is_close(rms)) break;
    goes_on = aims.advance(outcome(aim, rms, static_cast<std::size_t>(1000 / aim)));
    ++tries;
  }
  EXPECT_GE(tries, 3);
  EXPECT_LE(tries, 7);
  EXPECT_GT(best, right / 1.03);
}

TEST(aims, an_aim_that_spares_no_numbers_is_the_last) {
  Aims aims(kTolerance, kTolerance);
  ASSERT_TRUE(aims.advance(outcome(aims.aim(), 1.5, 100)));  // within the tolerance
  EXPECT_FALSE(aims.advance(outcome(aims.aim(), 2.5, 99)));  // outside the tolerance
}

TEST(aims, an_aim_that_spares_numbers_is_followed) {
  Aims aims(kTolerance, kTolerance);
  const double kept = aims.aim();
  ASSERT_TRUE(aims.advance(outcome(kept, 1.5, 100)));
  const double missed = aims.aim();
  ASSERT_TRUE(aims.advance(outcome(missed, 2.5, 80)));
  EXPECT_DOUBLE_EQ(aims.aim(), std::sqrt(kept * missed));
}

TEST(aims, aims_that_change_nothing_are_given_up) {
  Aims aims(kTolerance, kTolerance);
  ASSERT_TRUE(aims.advance(outcome(aims.aim(), 4, 100)));
  EXPECT_FALSE(aims.advance(outcome(aims.aim(), 3.9, 200)));
  Aims same(kTolerance, kTolerance);
  ASSERT_TRUE(same.advance(outcome(same.aim(), 1, 100)));
  EXPECT_FALSE(same.advance(outcome(same.aim(), 1, 100)));
}

// The samples of a slab came nearer than the aim: only smaller aims give new information.
TEST(aims, what_was_reached_counts_where_it_is_nearer_than_the_aim) {
  Aims aims(kTolerance, kTolerance);
  ASSERT_TRUE(
      aims.advance({.reached = 0.5, .rms = 4, .numbers = 100, .met = false, .whole = true}));
  EXPECT_LT(aims.aim(), 0.5);
}

TEST(aims, wrong_handles_are_tried_nearer_twice) {
  Aims aims(kTolerance, kTolerance);
  EXPECT_FALSE(aims.repeats(0));
  for (int k = 0; k < 2; ++k) {
    const double aim = aims.aim();
    ASSERT_TRUE(aims.advance(outcome(aim, 1.9, 100, false)));
    EXPECT_LT(aims.aim(), 0.8 * aim);
    EXPECT_TRUE(aims.repeats(100));
    EXPECT_FALSE(aims.repeats(120));
  }
  EXPECT_FALSE(aims.advance(outcome(aims.aim(), 1.9, 100, false)));
}

// Handles are right below 1.6 and wrong above. Aims move between right and wrong ones, never back.
TEST(aims, handles_that_are_right_nearer_are_looked_for_between) {
  Aims aims(kTolerance, kTolerance);
  double right = 0;
  for (int k = 0; k < 12; ++k) {
    const double aim = aims.aim();
    EXPECT_GT(aim, right);
    const bool whole = aim < 1.6;
    if (whole) right = aim;
    if (!aims.advance(outcome(aim, 0.99 * aim, static_cast<std::size_t>(1000 / aim), whole))) break;
  }
  EXPECT_GT(right, 1.6 / 1.04);
}

TEST(aims, a_right_surface_is_not_lost_to_a_looser_one_with_wrong_handles) {
  Aims aims(kTolerance, kTolerance);
  const double right = aims.aim();
  ASSERT_TRUE(aims.advance(outcome(right, 1.6, 100)));
  const double wrong = aims.aim();
  ASSERT_TRUE(aims.advance(outcome(wrong, 1.9, 80, false)));
  EXPECT_GT(aims.aim(), right);
  EXPECT_LT(aims.aim(), wrong);
}

}  // namespace
}  // namespace rholm
