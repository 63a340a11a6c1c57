// Expected values are tan(theta'/2) = a tan(theta/2) and its derivative.
#include "chart/cap/cap_frame.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace rholm {
namespace {

constexpr double kDilations[] = {0.25, 1, 1.5, 7, 40};

Vec3 direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

TEST(dilation, opens_an_angle_to_another) {
  const double a = dilation_between(0.3, 1.4);
  EXPECT_NEAR(2 * std::atan(a * std::tan(0.15)), 1.4, 1e-15);
  EXPECT_EQ(dilation_between(0.3, 0.3), 1);
}

TEST(dilation, keeps_the_longitude_and_multiplies_the_tangent_of_half_the_colatitude) {
  for (const double a : kDilations) {
    for (double theta = 0.1; theta < 3.1; theta += 0.1) {
      const Vec3 expected = direction(2 * std::atan(a * std::tan(theta / 2)), 2);
      EXPECT_NEAR(norm(dilated(a, direction(theta, 2)) - expected), 0, 1e-14) << a << " " << theta;
    }
  }
}

TEST(dilation, keeps_both_poles) {
  for (const double a : kDilations) {
    EXPECT_EQ(dilated(a, {0, 0, 1}), (Vec3{0, 0, 1}));
    EXPECT_EQ(dilated(a, {0, 0, -1}), (Vec3{0, 0, -1}));
  }
}

TEST(dilation, of_the_inverse_undoes_it) {
  for (const double a : kDilations) {
    const Vec3 u = direction(0.7, -1);
    EXPECT_NEAR(norm(dilated(1 / a, dilated(a, u)) - u), 0, 1e-14);
  }
}

// Central differences along the meridian and along the parallel agree: the map is conformal.
TEST(dilation, the_conformal_factor_is_how_lengths_grow) {
  const double h = 1e-5;
  for (const double a : kDilations) {
    for (double theta = 0.2; theta < 3; theta += 0.2) {
      const double factor = conformal_factor(a, std::cos(theta));
      const Vec3 down = dilated(a, direction(theta + h, 1)) - dilated(a, direction(theta - h, 1));
      const Vec3 along = dilated(a, direction(theta, 1 + h)) - dilated(a, direction(theta, 1 - h));
      // The error is of second order in h a (third derivative), plus rounding of 1e-16 / h.
      const double slack = factor * (a * a + 1 / (a * a)) * h * h + 1e-10;
      EXPECT_NEAR(norm(down) / (2 * h), factor, slack) << a << " " << theta;
      EXPECT_NEAR(norm(along) / (2 * h * std::sin(theta)), factor, slack / std::sin(theta));
    }
  }
}

}  // namespace
}  // namespace rholm
