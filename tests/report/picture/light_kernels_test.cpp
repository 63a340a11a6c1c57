#include "report/picture/light_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "base/random.h"
#include "support/targets.h"

namespace rholm {
namespace {

// Random cells, some of which see nothing. Positions differ by a few tenths of a step; normals
// differ by more or less than a crease. There are 14 rows of 50 cells, with NaN after the last
// cell.
class RandomCells {
 public:
  static constexpr int kWidth = 50, kRows = 14;

  explicit RandomCells(std::uint64_t seed) {
    for (std::size_t n = 0; n < numbers_.size(); ++n) {
      numbers_[n].assign(kWidth * kRows + kReadBeyond, std::nanf(""));
      for (std::size_t cell = 0; cell < kWidth * kRows; ++cell) {
        const double x = random_uniform(seed, n * kWidth * kRows + cell);
        const double side = x < 0.1 ? 0 : x < 0.2 ? -1 : 1;
        const double normal = n == kNormalZ ? 0.9 : 0.6 * (x - 0.5);
        numbers_[n][cell] = static_cast<float>(n == kSide                   ? side
                                               : n >= kNormalX && n < kSide ? normal
                                               : n >= kRed                  ? 0.1 * x
                                                                            : x);
      }
    }
  }
  CellRow row(int x, int y) const {
    CellRow row{.numbers = {}, .width = kWidth};
    for (std::size_t n = 0; n < numbers_.size(); ++n) row.numbers[n] = &numbers_[n][kWidth * y + x];
    return row;
  }
  float of(CellNumber n, int x, int y) const { return numbers_[n][kWidth * y + x]; }
  Spot spot(int x, int y) const {
    return {of(kX, x, y),       of(kY, x, y),       of(kZ, x, y),   of(kNormalX, x, y),
            of(kNormalY, x, y), of(kNormalZ, x, y), of(kSide, x, y)};
  }

 private:
  std::array<std::vector<float>, kCellNumbers> numbers_;
};

constexpr float kPerHalfDepth = 0.4f;

TEST(sum_windows, is_the_sum_over_each_window_by_likeness) {
  const RandomCells cells(1);
  constexpr int kX0 = 5, kY0 = 6, kMost = (RandomCells::kWidth - kX0 - kScouts * kReach) / kScouts;
  test::for_each_target([&](const std::string& name) {
    for (int n = 1; n <= kMost; ++n) {
      const WindowSums sums = sum_windows(cells.row(kX0, kY0), n, kPerHalfDepth);
      for (int k = 0; k < n; ++k) {
        const int x = kX0 + kScouts * k;
        float all = 0, sky = 0, key_all = 0, key_free = 0;
        for (int dy = -kReach; dy <= kReach; ++dy) {
          for (int dx = -kReach; dx <= kReach; ++dx) {
            const int u = x + kScouts * dx, v = kY0 + kScouts * dy;
            const float weight = kTent[dx + kReach] * kTent[dy + kReach] *
                                 likeness(cells.spot(x, kY0), cells.spot(u, v), kPerHalfDepth);
            all += weight;
            sky += weight * cells.of(kSky, u, v);
            key_all += weight * cells.of(kKeyAll, u, v);
            key_free += weight * cells.of(kKeyFree, u, v);
          }
        }
        ASSERT_EQ(sums.all[k], all) << name << ", scout " << k << " of " << n;
        ASSERT_EQ(sums.sky[k], sky) << name;
        ASSERT_EQ(sums.key_all[k], key_all) << name;
        ASSERT_EQ(sums.key_free[k], key_free) << name;
      }
    }
  });
}

// Evaluates the definition, cell by cell.
bool is_edge(const RandomCells& cells, int x, int y, float step) {
  const bool seen = cells.of(kSide, x, y) != 0;
  for (int v = y - 1; v <= y + 1; ++v) {
    for (int u = x - 1; u <= x + 1; ++u) {
      if ((cells.of(kSide, u, v) != 0) != seen) return true;
      for (const CellNumber root : {kRed, kGreen, kBlue}) {
        if (std::abs(cells.of(root, x, y) - cells.of(root, u, v)) > step) return true;
      }
    }
  }
  const auto alike = [&](int u, int v) {
    return likeness(cells.spot(x, y), cells.spot(u, v), kPerHalfDepth) > 0;
  };
  return seen && !(alike(x - 1, y) && alike(x + 1, y) && alike(x, y - 1) && alike(x, y + 1));
}

TEST(find_edges, finds_other_things_steps_of_colour_and_creases) {
  constexpr int kX0 = 1, kY0 = 12, kMost = RandomCells::kWidth - 2;
  test::for_each_target([&](const std::string& name) {
    std::array<int, 2> count = {};
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const RandomCells cells(seed);
      const float step = 0.01f * static_cast<float>(seed);
      for (const int n : {1, 7, 8, 9, kMost}) {
        const std::vector<std::uint8_t> edges =
            find_edges(cells.row(kX0, kY0), n, kPerHalfDepth, step);
        for (int k = 0; k < n; ++k) {
          const bool wanted = is_edge(cells, kX0 + k, kY0, step);
          ASSERT_EQ(edges[k], wanted) << name << ", cell " << k << " of " << n;
          ++count[wanted];
        }
      }
    }
    EXPECT_GT(count[0], 10);
    EXPECT_GT(count[1], 10);
  });
}

}  // namespace
}  // namespace rholm
