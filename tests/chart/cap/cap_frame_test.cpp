// Expected values follow from the definition (method 7.1 and 7.2).
#include "chart/cap/cap_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/random_data.h"

namespace rholm {
namespace {

// Returns axes along the coordinate axes, between them, and in random directions.
std::vector<Vec3> axes() {
  std::vector<Vec3> all = {{1, 0, 0}, {0, -2, 0}, {0, 0, 3}, {1, 1, 0}, {-1, 1, 1}};
  for (std::uint64_t i = 0; i < 20; ++i) {
    all.push_back(
        {test::random_in(-1, 1, 1, i), test::random_in(-1, 1, 2, i), test::random_in(-1, 1, 3, i)});
  }
  return all;
}

TEST(CapFrame, axes_are_orthonormal_and_right_handed) {
  for (const Vec3& axis : axes()) {
    const CapFrame f = cap_frame({1, 2, 3}, axis, 0.3, 0.4, 1.2);
    EXPECT_NEAR(norm(f.z - normalized(axis)), 0, 1e-15);
    EXPECT_NEAR(norm(f.x), 1, 1e-15);
    EXPECT_NEAR(dot(f.x, f.z), 0, 1e-15);
    EXPECT_NEAR(norm(cross(f.z, f.x) - f.y), 0, 1e-15);
  }
}

TEST(CapFrame, the_support_is_seen_under_the_angle_and_opened_to_the_other) {
  const double support = 0.3, half_angle = 0.4, opened = 1.2;
  for (const Vec3& axis : axes()) {
    const Vec3 seed{1, 2, 3};
    const CapFrame f = cap_frame(seed, axis, support, half_angle, opened);
    EXPECT_NEAR(norm(f.seed() - seed), 0, 1e-15 * 4);  // |seed| = 3.7
    EXPECT_EQ(f.support, support);
    const Vec3 rim = normalized(in_frame(f, seed + support * f.y));
    EXPECT_NEAR(std::atan2(rim.y, rim.z), half_angle, 1e-14);
    const Vec3 wide = dilated(f.dilation, rim);
    EXPECT_NEAR(std::atan2(wide.y, wide.z), opened, 1e-14);
  }
}

TEST(CapFrame, points_in_the_frame_are_in_radii_from_the_centre) {
  const CapFrame f = cap_frame({1, 2, 3}, {1, -1, 2}, 0.3, 0.4, 1.2);
  const Vec3 at{0.5, -0.25, 2};
  const Vec3 x = f.center + f.radius * (at.x * f.x + at.y * f.y + at.z * f.z);
  EXPECT_NEAR(norm(in_frame(f, x) - at), 0, 1e-14);
  EXPECT_NEAR(norm(in_frame(f, f.seed()) - Vec3{0, 0, 1}), 0, 1e-14);
}

}  // namespace
}  // namespace rholm
