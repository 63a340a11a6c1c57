// The search for an aim, on outcomes that are known.
#include "model/atlas_aims.h"

#include <gtest/gtest.h>

namespace rholm {
namespace {

constexpr double kTolerance = 2;

AimOutcome outcome(double aim, double rms, std::size_t numbers, bool odd = false) {
  return {.reached = aim, .rms = rms, .numbers = numbers, .met = rms <= kTolerance, .odd = odd};
}

TEST(aims, a_factor_is_found_at_once) {
  Aims aims(kTolerance, kTolerance);
  ASSERT_TRUE(aims.advance(outcome(aims.aim(), 1.6 * aims.aim(), 100)));
  const double rms = 1.6 * aims.aim();
  EXPECT_LE(rms, kTolerance);
  EXPECT_TRUE(aims.is_close(rms));
}

// rms = 0.7 aim^1.5 meets 2 at aim = (2 / 0.7)^(2/3); numbers fall as 1 / aim.
TEST(aims, a_power_is_halved_until_the_aims_are_the_same) {
  Aims aims(kTolerance, kTolerance);
  const double right = std::pow(kTolerance / 0.7, 2.0 / 3);
  int tries = 0;
  bool goes_on = true;
  double best = 0;
  while (goes_on && tries < 20) {
    const double aim = aims.aim(), rms = 0.7 * std::pow(aim, 1.5);
    if (rms <= kTolerance) best = std::max(best, aim);
    if (rms <= kTolerance && aims.is_close(rms)) break;
    goes_on = aims.advance(outcome(aim, rms, static_cast<std::size_t>(1000 / aim)));
    ++tries;
  }
  EXPECT_LE(tries, 6);
  EXPECT_GT(best, right / 1.03);
}

TEST(aims, an_aim_that_spares_no_numbers_is_the_last) {
  Aims aims(kTolerance, kTolerance);
  ASSERT_TRUE(aims.advance(outcome(aims.aim(), 1.5, 100)));  // kept
  EXPECT_FALSE(aims.advance(outcome(aims.aim(), 2.5, 99)));  // missed
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

// The samples of a slab came nearer than was aimed at: only what lies below that says more.
TEST(aims, what_was_reached_counts_where_it_is_nearer_than_the_aim) {
  Aims aims(kTolerance, kTolerance);
  ASSERT_TRUE(aims.advance({.reached = 0.5, .rms = 4, .numbers = 100, .met = false, .odd = false}));
  EXPECT_LT(aims.aim(), 0.5);
}

TEST(aims, odd_handles_are_tried_nearer_twice) {
  Aims aims(kTolerance, kTolerance);
  EXPECT_FALSE(aims.is_old(0));
  for (int k = 0; k < 2; ++k) {
    const double aim = aims.aim();
    ASSERT_TRUE(aims.advance(outcome(aim, 1.9, 100, true)));
    EXPECT_LT(aims.aim(), 0.8 * aim);
    EXPECT_TRUE(aims.is_old(100));
    EXPECT_FALSE(aims.is_old(120));
  }
  EXPECT_FALSE(aims.advance(outcome(aims.aim(), 1.9, 100, true)));
}

}  // namespace
}  // namespace rholm
