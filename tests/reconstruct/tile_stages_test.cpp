#include "reconstruct/points/tile_stages.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "parts/threads.h"
#include "rholm/error.h"

namespace rholm {
namespace {

TEST(time_left, is_that_of_costs_at_the_speed_so_far) {
  TimeLeft left({{"a", 1}, {"b", 3}});
  EXPECT_FALSE(left.is_known());
  left.done("a", 0.5, 20);
  left.done("a", 1, 40);
  EXPECT_TRUE(left.is_known());
  EXPECT_DOUBLE_EQ(left.seconds(), 120);
  left.done("b", 0.5, 160);  // slower than foreseen
  EXPECT_DOUBLE_EQ(left.seconds(), 160 * 1.5 / 2.5);
  left.add({{"c", 1}});
  EXPECT_DOUBLE_EQ(left.seconds(), 160);
  left.done("b", 1, 200);
  left.done("c", 1, 300);
  EXPECT_DOUBLE_EQ(left.seconds(), 0);
}

TEST(time_left, does_not_count_what_was_done_before) {
  TimeLeft left({{"a", 1}, {"b", 3}});
  left.done("a", 1, 0);  // in no time
  EXPECT_FALSE(left.is_known());
  left.done("b", 0.5, 60);
  EXPECT_DOUBLE_EQ(left.seconds(), 60);
  left.done("unknown", 1, 90);  // takes time, and is nothing that was foreseen
  EXPECT_DOUBLE_EQ(left.seconds(), 90);
}

TEST(time_left, is_said_as_exactly_as_it_is_known) {
  EXPECT_EQ(text_of_seconds(1), "5 s");
  EXPECT_EQ(text_of_seconds(43), "45 s");
  EXPECT_EQ(text_of_seconds(58), "1 min");
  EXPECT_EQ(text_of_seconds(3000), "50 min");
  EXPECT_EQ(text_of_seconds(7500), "2 h 5 min");
}

TEST(tile_stages, tell_of_tiles_and_ask_whether_to_go_on) {
  std::vector<std::string> told;
  std::size_t asked = 0;
  Context context;
  context.progress = [&](std::string_view stage, double part) {
    ++asked;
    if (!stage.empty())
      told.push_back(std::string(stage) + " " + std::to_string(part).substr(0, 4));
    return asked < 100;
  };
  Threads alone;
  StageTimes times;
  TileStages stages(alone, {{"first", 1}}, times, context);
  std::vector<std::size_t> tiles;
  stages.each("first", 4, [&](std::size_t tile) {
    tiles.push_back(tile);
    // What loops within tell is part of the stage.
    stages.context().progress("inner", 0.9);
  });
  EXPECT_EQ(tiles, (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(told, (std::vector<std::string>{"first 0.00", "first 0.00", "first 0.25", "first 0.25",
                                            "first 0.50", "first 0.50", "first 0.75", "first 0.75",
                                            "first 1.00"}));
  EXPECT_EQ(times.count("first"), 1U);
  asked = 100;
  EXPECT_THROW(stages.once("second", [] { FAIL() << "it was cancelled"; }), Error);
}

}  // namespace
}  // namespace rholm
