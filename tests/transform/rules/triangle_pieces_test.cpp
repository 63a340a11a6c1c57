#include "transform/rules/triangle_pieces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random_data.h"

namespace rholm {
namespace {

using test::random_direction;

double area(const std::array<Vec3, 3>& p) { return norm(cross(p[1] - p[0], p[2] - p[0])) / 2; }

struct Pieces {
  std::size_t n = 0;
  double share = 0, largest_share_error = 0;
};

// Cuts until pieces are short compared with their distance.
void cut_all(const std::array<Vec3, 3>& p, double share, double whole, Pieces& pieces) {
  constexpr double kLongest = 0.5;
  const std::size_t k = longest_side(p);
  if (norm(p[(k + 1) % 3] - p[k]) <= kLongest * triangle_distance(p)) {
    ++pieces.n;
    pieces.share += share;
    pieces.largest_share_error =
        std::max(pieces.largest_share_error, std::abs(area(p) - share * whole) / whole);
    return;
  }
  ASSERT_LT(pieces.n, 100000U);
  cut_triangle(p, kLongest, [&](const std::array<Vec3, 3>& piece, double part) {
    cut_all(piece, share * part, whole, pieces);
  });
}

TEST(cut_triangle, has_pieces_whose_shares_are_their_areas_and_add_up_to_one) {
  for (std::uint64_t i = 0; i < 30; ++i) {
    const Vec3 far{0, 0, 2};
    const std::array<Vec3, 3> p = {
        far + random_direction(i, 0),
        far + std::exp2(-static_cast<double>(i)) * random_direction(i, 1),
        far + random_direction(i, 2)};
    Pieces pieces;
    cut_all(p, 1, area(p), pieces);
    EXPECT_NEAR(pieces.share, 1, 1e-13);
    EXPECT_LT(pieces.largest_share_error, 1e-12);
  }
}

// A needle along x passes the centre at distance 1. Halving its longest edge would make a number of
// pieces proportional to its length.
TEST(cut_triangle, makes_as_many_pieces_of_a_needle_as_its_length_has_digits) {
  for (int digits = 1; digits <= 12; ++digits) {
    const double length = std::pow(10, digits);
    for (const double middle : {-0.9, 0.0, 0.3, 0.9}) {
      const std::array<Vec3, 3> p = {Vec3{-length, 1, 0}, Vec3{length, 1.1, 0.2},
                                     Vec3{middle * length, 1, 0.5}};
      Pieces pieces;
      cut_all(p, 1, area(p), pieces);
      EXPECT_LT(pieces.n, 100U + 60U * static_cast<std::size_t>(digits)) << length;
    }
  }
}

}  // namespace
}  // namespace rholm
