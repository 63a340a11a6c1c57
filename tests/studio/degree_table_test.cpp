// A function truncated at each of its degrees, compared with the library's sums.
#include "studio/items/degree_table.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/random.h"
#include "rholm/filter.h"
#include "rholm/harmonic.h"
#include "rholm/primitives.h"

namespace rholm::studio {
namespace {

Coefficients random_coefficients(int degree) {
  Coefficients c(degree);
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      const auto i = static_cast<std::uint64_t>(l * 1000 + m);
      c.c(l, m) = (2 * random_uniform(1, i) - 1) / (1 + l);
      if (m > 0) c.s(l, m) = (2 * random_uniform(2, i) - 1) / (1 + l);
    }
  }
  return c;
}

// Poles, the equator, and other places; their number does not fill a block.
std::vector<Vec3> directions() {
  std::vector<Vec3> u = icosphere(2).vertices;
  u.push_back({0, 0, 1});
  u.push_back({0, 0, -1});
  u.push_back({1, 0, 0});
  u.push_back(normalized({1e-9, 1e-9, 1}));
  return u;
}

TEST(DegreeTable, SumsAreThoseOfTheLibraryAtEveryDegree) {
  const Coefficients c = random_coefficients(40);
  const std::vector<Vec3> u = directions();
  const std::vector<double> base(u.size(), 0.0);
  const DegreeTable table(c, u, base);
  for (const int d : {0, 1, 2, 3, 17, 39, 40}) {
    const std::vector<double> values = evaluate(c.resized(d), u, {.engine = Engine::kDirect});
    const std::span<const float> row = table.cut_off_at(d);
    ASSERT_EQ(row.size(), u.size());
    for (std::size_t j = 0; j < u.size(); ++j)
      EXPECT_NEAR(row[j], values[j], 1e-6) << d << ' ' << j;
  }
}

TEST(DegreeTable, HighDegreesDoNotUnderflowWhereTheyCount) {
  const int degree = 400;
  const Coefficients c = random_coefficients(degree);
  const std::vector<Vec3> u = {
      normalized({0.02, 0.01, 1}), normalized({0.5, -0.2, 0.4}), {0, 1, 0}};
  const std::vector<double> values = evaluate(c, u, {.engine = Engine::kDirect});
  const DegreeTable table(c, u, values);  // only rounding is left
  for (const float left : table.cut_off_at(degree)) EXPECT_NEAR(left, 0, 1e-10);
}

TEST(DegreeTable, GainsAreAFilter) {
  const Coefficients c = random_coefficients(12);
  const std::vector<Vec3> u = directions();
  std::vector<double> base(u.size());
  for (std::size_t j = 0; j < u.size(); ++j) base[j] = 0.3 + 0.01 * static_cast<double>(j);
  const DegreeTable table(c, u, base);
  std::vector<double> gains;
  for (int l = 0; l <= 9; ++l) gains.push_back(1.5 - 0.2 * l);
  const std::vector<double> values = evaluate(filter(c, gains), u, {.engine = Engine::kDirect});
  const std::vector<float> found = table.filtered(gains, base);
  for (std::size_t j = 0; j < u.size(); ++j) EXPECT_NEAR(found[j], values[j] - base[j], 3e-6);
  const std::vector<float> nothing = table.filtered({}, base);
  for (std::size_t j = 0; j < u.size(); ++j) EXPECT_NEAR(nothing[j], -base[j], 1e-6);
}

TEST(DegreeTable, TooMuchDoesNotFit) {
  EXPECT_TRUE(DegreeTable::fits(24500, 180));
  EXPECT_FALSE(DegreeTable::fits(100000000, 180));
  EXPECT_FALSE(DegreeTable::fits(1000, 4000));
}

}  // namespace
}  // namespace rholm::studio
