// Expected values are the values that were added.
#include "transform/mesh_pass/twin_cache.h"

#include <gtest/gtest.h>

#include <vector>

namespace rholm {
namespace {

struct Side {
  int kind = 0;
  long weight = 0;
  friend bool operator==(const Side&, const Side&) = default;
};

struct Worked {
  TwinCache<Side> cache;
  std::vector<Side> sides;

  void add(std::uint32_t i, std::uint32_t j, const Side& side) {
    const auto join = [](Side& twin, const Side& other) {
      if (twin.kind != other.kind) return false;
      twin.weight += other.weight;
      return true;
    };
    cache.add(i, j, side, join, [&](std::uint32_t low, std::uint32_t high, const Side& s) {
      EXPECT_LT(low, high);
      sides.push_back(s);
    });
  }
  void flush() {
    cache.flush([&](std::uint32_t, std::uint32_t, const Side& s) { sides.push_back(s); });
  }
};

TEST(twin_cache, twins_are_worked_once_as_soon_as_both_are_there) {
  Worked worked;
  worked.add(7, 4, {.kind = 1, .weight = 10});
  EXPECT_TRUE(worked.sides.empty());
  worked.add(4, 7, {.kind = 1, .weight = 5});
  EXPECT_EQ(worked.sides, (std::vector<Side>{{1, 15}}));
  worked.flush();
  EXPECT_EQ(worked.sides.size(), 1U);
}

TEST(twin_cache, twins_that_do_not_join_are_worked_apart) {
  Worked worked;
  worked.add(0, 1, {.kind = 1, .weight = 10});
  worked.add(1, 0, {.kind = 2, .weight = 5});
  EXPECT_EQ(worked.sides, (std::vector<Side>{{1, 10}}));
  worked.flush();
  EXPECT_EQ(worked.sides, (std::vector<Side>{{1, 10}, {2, 5}}));
  worked.flush();
  EXPECT_EQ(worked.sides.size(), 2U);
}

// Two rounds over many more edges than fit: each edge is handled at least once and at most twice,
// and nothing is lost.
TEST(twin_cache, what_is_driven_out_is_worked_alone) {
  constexpr std::uint32_t n = 100000;
  Worked worked;
  for (int round = 0; round < 2; ++round) {
    for (std::uint32_t i = 0; i < n; ++i) worked.add(i, i + 1, {.kind = 0, .weight = i});
  }
  worked.flush();
  EXPECT_GT(worked.sides.size(), n);
  EXPECT_LE(worked.sides.size(), 2 * n);
  long sum = 0;
  for (const Side& side : worked.sides) sum += side.weight;
  EXPECT_EQ(sum, static_cast<long>(n) * (n - 1));
}

}  // namespace
}  // namespace rholm
