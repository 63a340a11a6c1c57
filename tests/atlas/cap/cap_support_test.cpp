// The support of a cap. Expected values are the second moments of discs, ellipses and lines in
// closed form, and differences of the quadratic form.
#include "atlas/cap/cap_support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "chart/cap/cap_frame.h"
#include "support/random_data.h"

namespace rholm {
namespace {

using std::numbers::pi;
using test::random_in;

constexpr double kRadius = 0.4;

Cap make_cap() {
  Cap cap;
  cap.frame = cap_frame({1, 2, 3}, {0.3, -0.5, 0.9}, kRadius, 0.5, 1.4);
  set_support(cap, kRadius);
  return cap;
}

// Returns a cap whose ellipse is turned and is not centred at the seed.
constexpr double kLong = 0.3, kShort = 0.2, kTurn = 0.7, kP = 0.05, kQ = -0.03;
Cap oblique_cap() {
  Cap cap = make_cap();
  const double c = std::cos(kTurn), s = std::sin(kTurn);
  const double a = 1 / (kLong * kLong), b = 1 / (kShort * kShort);
  cap.where = {kP, kQ, a * c * c + b * s * s, (a - b) * c * s, a * s * s + b * c * c};
  return cap;
}

// Returns the offset from the seed of a point given along the ellipse's axes and the normal.
Vec3 along_axes(const Cap& cap, double along, double across, double height) {
  const double c = std::cos(kTurn), s = std::sin(kTurn);
  return (kP + c * along - s * across) * cap.frame.x + (kQ + s * along + c * across) * cap.frame.y +
         height * cap.frame.z;
}

// Returns points that each stand for an equal area of the ellipse with these semi-axes.
CapPoints fill(const Cap& cap, double along, double across) {
  constexpr int kRings = 64;
  CapPoints points;
  for (int ring = 0; ring < kRings; ++ring) {
    const double r = std::sqrt((ring + 0.5) / kRings);
    for (int k = 0; k < 32; ++k) {
      const double angle = 2 * pi * k / 32;
      points.add(along_axes(cap, r * along * std::cos(angle), r * across * std::sin(angle), 0.1),
                 cap.frame.z, 1);
    }
  }
  points.pad();
  return points;
}

TEST(CapSupport, place_is_0_in_the_middle_1_at_the_rim_and_grows_with_the_height) {
  const Cap cap = oblique_cap();
  EXPECT_NEAR(place(cap, along_axes(cap, 0, 0, 0)), 0, 1e-15);
  EXPECT_NEAR(place(cap, along_axes(cap, kLong, 0, 0)), 1, 1e-13);
  EXPECT_NEAR(place(cap, along_axes(cap, 0, -kShort, 0)), 1, 1e-13);
  EXPECT_NEAR(place(cap, along_axes(cap, 0, 0, kRadius)), 1, 1e-13);
  EXPECT_NEAR(place(cap, along_axes(cap, kLong / 2, kShort / 2, -kRadius / 2)), 0.75, 1e-13);
  EXPECT_LT(norm(cap.frame.seed() + along_axes(cap, 0, 0, 0) - support_middle(cap)), 1e-15);
}

TEST(CapSupport, a_disc_reaches_as_far_as_its_radius) {
  Cap cap = make_cap();
  set_support(cap, 0.25);
  for (int k = 0; k < 8; ++k) {
    const Vec3 u = std::cos(k) * cap.frame.x + std::sin(k) * cap.frame.y;
    EXPECT_NEAR(place(cap, 0.25 * u), 1, 1e-14);
  }
  EXPECT_NEAR(place(cap, -0.25 * cap.frame.z), 1, 1e-14);
  EXPECT_NEAR(longer_half_axis(cap.where), 0.25, 1e-15);
}

TEST(CapSupport, gradient_is_that_of_the_place) {
  const Cap cap = oblique_cap();
  const double h = 1e-5;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Vec3 at = {random_in(-0.4, 0.4, 1, i), random_in(-0.4, 0.4, 2, i),
                     random_in(-0.4, 0.4, 3, i)};
    const Vec3 gradient = support_gradient(cap, at);
    // Central differences of a quadratic form are exact except for rounding.
    for (const Vec3& u : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      const double slope = (place(cap, at + h * u) - place(cap, at - h * u)) / (2 * h);
      EXPECT_NEAR(dot(gradient, u), slope, 1e-9);
    }
  }
}

TEST(CapSupport, longer_half_axis_is_the_farthest_that_the_ellipse_reaches) {
  const Cap cap = oblique_cap();
  EXPECT_NEAR(longer_half_axis(cap.where), kLong, 1e-14);
  for (int k = 0; k < 64; ++k) {
    const double angle = 2 * pi * k / 64, far = 1.0001 * kLong;
    EXPECT_GT(place(cap, along_axes(cap, far * std::cos(angle), far * std::sin(angle), 0)), 1);
  }
}

// Rings of equal angles have the ellipse's moments to rounding, except for the mean of r^2.
TEST(CapSupport, points_that_fill_an_ellipse_have_it) {
  const Cap cap = oblique_cap();
  const CapPoints points = fill(cap, kLong, kShort);
  const PlaneMoments moments = moments_of(cap.frame, points);
  EXPECT_NEAR(moments.p, kP, 1e-14);
  EXPECT_NEAR(moments.q, kQ, 1e-14);
  EXPECT_NEAR(moments.middle + moments.radius, kLong * kLong / 4, 1e-14);
  EXPECT_NEAR(moments.middle - moments.radius, kShort * kShort / 4, 1e-14);
  EXPECT_TRUE(fills_ellipse(cap.frame, moments));
  const CapSupport found = ellipse_of(cap.frame, moments);
  EXPECT_NEAR(found.px, kP, 1e-14);
  EXPECT_NEAR(found.py, kQ, 1e-14);
  EXPECT_NEAR(found.xx, cap.where.xx, 1e-11);
  EXPECT_NEAR(found.xy, cap.where.xy, 1e-11);
  EXPECT_NEAR(found.yy, cap.where.yy, 1e-11);
}

// For points on a line the ellipse is as long as the support and has the smallest allowed width.
TEST(CapSupport, points_on_a_line_have_the_thinnest_ellipse) {
  Cap cap = make_cap();
  const PlaneMoments moments = moments_of(cap.frame, fill(cap, 2 * kRadius, 0));
  EXPECT_FALSE(fills_ellipse(cap.frame, moments));
  cap.where = ellipse_of(cap.frame, moments);
  const double thin = std::sqrt(kThinnest) * kRadius;
  EXPECT_NEAR(longer_half_axis(cap.where), kRadius, 1e-14);
  EXPECT_NEAR(place(cap, along_axes(cap, kRadius, 0, 0)), 1, 1e-12);
  EXPECT_NEAR(place(cap, along_axes(cap, 0, thin, 0)), 1, 1e-12);
}

TEST(CapSupport, one_point_has_the_smallest_circle_around_it) {
  Cap cap = make_cap();
  CapPoints points;
  points.add(along_axes(cap, 0, 0, 0), cap.frame.z, 1);
  points.pad();
  cap.where = ellipse_of(cap.frame, moments_of(cap.frame, points));
  EXPECT_NEAR(longer_half_axis(cap.where), std::sqrt(kThinnest) * kRadius, 1e-14);
  EXPECT_NEAR(place(cap, along_axes(cap, 0, 0, 0)), 0, 1e-14);
}

}  // namespace
}  // namespace rholm
