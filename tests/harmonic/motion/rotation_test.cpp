#include "rholm/rotate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "harmonic/motion/rotation_quarter.h"
#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "support/random_data.h"

namespace rholm {
namespace {

using test::norm_of;
using test::random_coefficients;
using test::random_direction;
using test::random_directions;
using test::random_in;
using test::relative_difference;

constexpr double kPi = std::numbers::pi;

Rotation random_rotation(std::uint64_t seed) {
  return rotation_about(random_direction(seed, 0), random_in(0, 2 * kPi, seed, 99));
}

Expansion expansion_of(const Coefficients& coefficients, const Vec3& center) {
  Expansion expansion;
  expansion.coefficients = coefficients;
  expansion.center = center;
  return expansion;
}

template <typename Call>
void expect_refused(Call call) {
  try {
    call();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
  }
}

void expect_near(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_NEAR(norm(a - b), 0, tolerance) << a.x << " " << a.y << " " << a.z;
}

// Returns |f(R^-1 u) - g(u)| over random directions and the poles, relative to the rms of f.
double pointwise_difference(const Coefficients& f, const Coefficients& g, const Rotation& r,
                            std::size_t n) {
  const std::vector<Vec3> to = random_directions(n, 7);
  std::vector<Vec3> from;
  from.reserve(to.size());
  for (const Vec3& u : to) from.push_back(rotate(u, inverse(r)));
  const auto a = evaluate(f, from, {.engine = Engine::kDirect});
  const auto b = evaluate(g, to, {.engine = Engine::kDirect});
  double worst = 0;
  for (std::size_t i = 0; i < n; ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst / (norm_of(f.values()) / std::sqrt(4 * kPi));
}

TEST(rotation, about_an_axis_follows_the_right_hand) {
  expect_near(rotate({1, 0, 0}, rotation_about({0, 0, 3}, kPi / 2)), {0, 1, 0}, 1e-15);
  expect_near(rotate({0, 1, 0}, rotation_about({1, 0, 0}, kPi / 2)), {0, 0, 1}, 1e-15);
  expect_near(rotate({0, 0, 1}, rotation_about({0, 1e-200, 0}, kPi / 2)), {1, 0, 0}, 1e-15);
  // Rodrigues' formula for x perpendicular to the axis: cos a x + sin a axis x x.
  const Vec3 axis = normalized({1, 2, -2}), x = normalized(cross(axis, {0, 0, 1}));
  expect_near(rotate(x, rotation_about(axis, 0.7)),
              std::cos(0.7) * x + std::sin(0.7) * cross(axis, x), 1e-15);
}

TEST(rotation, all_forms_say_the_same) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Rotation r = random_rotation(seed);
    EXPECT_LT(angle_between(rotation_of(matrix_of(r)), r), 1e-15 * 8);
    EXPECT_LT(angle_between(rotation_of(euler_angles_of(r)), r), 1e-15 * 8);
    const AxisAngle a = axis_angle_of(r);
    EXPECT_LT(angle_between(rotation_about(a.axis, a.angle), r), 1e-15 * 8);
    const Rotation q = random_rotation(seed + 1000);
    const Vec3 x = random_direction(seed, 5);
    expect_near(rotate(x, compose(q, r)), rotate(rotate(x, r), q), 2e-15);
  }
}

TEST(rotation, euler_angles_are_turns_about_z_y_z) {
  const EulerAngles e{0.3, 1.1, -2.0};
  const Rotation turns =
      compose(rotation_about({0, 0, 1}, e.alpha),
              compose(rotation_about({0, 1, 0}, e.beta), rotation_about({0, 0, 1}, e.gamma)));
  EXPECT_LT(angle_between(rotation_of(e), turns), 1e-15);
  EXPECT_NEAR(euler_angles_of(turns).beta, e.beta, 1e-15);
}

TEST(rotation, euler_angles_of_almost_none_keep_their_sum) {
  // Near beta = 0 the two other angles are undetermined, but their sum is determined.
  for (const double tilt : {0.0, 1e-17, 1e-9, 1e-5}) {
    const Rotation r = compose(rotation_about({1, 2, 0}, tilt), rotation_about({0, 0, 1}, 0.25));
    EXPECT_LT(angle_between(rotation_of(euler_angles_of(r)), r), 1e-15) << tilt;
  }
  const Rotation half = rotation_about({1, 3, 1e-9}, kPi);
  EXPECT_LT(angle_between(rotation_of(euler_angles_of(half)), half), 1e-15);
}

TEST(rotation, what_is_not_a_rotation_is_refused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused([] { rotation_about({0, 0, 0}, 1); });
  expect_refused([&] { rotation_about({nan, 0, 0}, 1); });
  expect_refused([&] { rotation_about({1, 0, 0}, nan); });
  expect_refused([&] { rotation_of(EulerAngles{0, nan, 0}); });
  expect_refused([] { rotation_of(RotationMatrix{Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1.01}}); });
  expect_refused([] { rotation_of(RotationMatrix{Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}); });
  expect_refused([&] { rotation_of(RotationMatrix{Vec3{1, 0, 0}, {0, nan, 0}, {0, 0, 1}}); });
  expect_refused([] { rotate(Coefficients(2), Rotation{0, 0, 0, 0}); });
}

TEST(rotation, degree_one_turns_like_a_vector) {
  // f = a . u has C_11 = k a_x, S_11 = k a_y, C_10 = k a_z, k = sqrt(4 pi/3).
  const Vec3 a = {0.3, -1.2, 2.0};
  Coefficients f(1);
  f.c(1, 1) = a.x, f.s(1, 1) = a.y, f.c(1, 0) = a.z;
  const Rotation r = random_rotation(3);
  const Coefficients g = rotate(f, r);
  expect_near({g.c(1, 1), g.s(1, 1), g.c(1, 0)}, rotate(a, r), 1e-15 * 4);
}

TEST(rotation, degree_two_turns_like_a_matrix) {
  // u^T diag(2, -1, -1) u / 2 = (3 x^2 - 1) / 2 is P_2 about x: P_2 about z, turned from z to x. In
  // this basis x^2 - 1/3 = [ -C_20 part / 2 + sqrt(3)/2 C_22 part ] of z^2 - 1/3.
  Coefficients f(2);
  f.c(2, 0) = 1;
  const Coefficients g = rotate(f, rotation_about({0, 1, 0}, kPi / 2));
  EXPECT_NEAR(g.c(2, 0), -0.5, 1e-15);
  EXPECT_NEAR(g.c(2, 2), std::sqrt(3.0) / 2, 1e-15);
  EXPECT_NEAR(g.c(2, 1), 0, 1e-15);
  EXPECT_NEAR(g.s(2, 2), 0, 1e-15);
}

TEST(rotation, values_are_those_at_the_directions_turned_back) {
  for (const int degree : {0, 1, 2, 3, 7, 20, 64}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const Coefficients f = random_coefficients(degree, seed);
      const Rotation r = random_rotation(seed + 50);
      // The error is measured below 3e-14; phases of direct sums at turned directions lose L eps.
      EXPECT_LT(pointwise_difference(f, rotate(f, r), r, 40), 2e-15 * (degree + 8) * 4)
          << degree << " " << seed;
    }
  }
}

TEST(rotation, values_at_degree_512_are_right_to_eleven_digits) {
  const Coefficients f = random_coefficients(512, 1);
  const Rotation r = random_rotation(2);
  EXPECT_LT(pointwise_difference(f, rotate(f, r), r, 60), 1e-11);
}

TEST(rotation, there_and_back_at_degree_512_is_right_to_twelve_digits) {
  const Coefficients f = random_coefficients(512, 1);
  const Rotation r = random_rotation(4);
  EXPECT_LT(relative_difference(rotate(rotate(f, r), inverse(r)), f), 1e-12);
}

// From degree 1000 on, the first values of the recurrence underflow. J is the quarter turn about
// y.
TEST(rotation, one_degree_far_up_keeps_its_energy_and_its_values) {
  const int l = 2600;
  Coefficients f(l);
  for (int m = 0; m <= l; ++m) {
    f.c(l, m) = random_in(-1, 1, 5, static_cast<std::uint64_t>(2 * m));
    if (m > 0) f.s(l, m) = random_in(-1, 1, 5, static_cast<std::uint64_t>(2 * m + 1));
  }
  Coefficients g = f;
  QuarterTurn turn;
  turn.set_degree(l);
  turn.apply(QuarterTurn::Way::kForward, &g.c(l, 0), &g.s(l, 0));
  EXPECT_NEAR(norm_of(g.values()) / norm_of(f.values()), 1, 1e-13);
  EXPECT_LT(pointwise_difference(f, g, rotation_about({0, 1, 0}, kPi / 2), 10), 1e-11);
  turn.apply(QuarterTurn::Way::kInverse, &g.c(l, 0), &g.s(l, 0));
  EXPECT_LT(relative_difference(g, f), 1e-12);
}

// Sums over m of Delta_{m1 m} Delta_{m2 m}: rows of an orthogonal matrix, for all signs of the
// orders.
TEST(rotation, quarter_turns_are_orthogonal_for_all_orders) {
  QuarterTurn turn;
  for (const int l : {0, 1, 2, 5, 30}) {
    turn.set_degree(l);
    for (int m1 = -l; m1 <= l; ++m1) {
      for (int m2 = -l; m2 <= l; ++m2) {
        double sum = 0;
        for (int m = -l; m <= l; ++m) sum += turn.delta(m1, m) * turn.delta(m2, m);
        EXPECT_NEAR(sum, m1 == m2, 1e-14) << l << " " << m1 << " " << m2;
      }
    }
  }
}

// d^1(pi/2) and d^2(pi/2) as in Varshalovich, Moskalev, Khersonskii, tables 4.3 and 4.4.
TEST(rotation, quarter_turns_of_degrees_one_and_two_are_those_of_tables) {
  const double h = 0.5, r = std::sqrt(0.5), q = 0.25, s = std::sqrt(6.0) / 4;
  const double one[3][3] = {{h, -r, h}, {r, 0, -r}, {h, r, h}};  // m1 and m2 are 1, 0, -1
  const double two[5][5] = {
      {q, -h, s, -h, q}, {h, -h, 0, h, -h}, {s, 0, -h, 0, s}, {h, h, 0, -h, -h}, {q, h, s, h, q}};
  QuarterTurn turn;
  turn.set_degree(1);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(turn.delta(1 - i, 1 - k), one[i][k], 1e-15);
  }
  turn.set_degree(2);
  for (int i = 0; i < 5; ++i) {
    for (int k = 0; k < 5; ++k) EXPECT_NEAR(turn.delta(2 - i, 2 - k), two[i][k], 1e-15);
  }
}

TEST(rotation, two_turns_are_the_turn_composed) {
  const Coefficients f = random_coefficients(40, 1);
  const Rotation r = random_rotation(5), q = random_rotation(6);
  EXPECT_LT(relative_difference(rotate(rotate(f, r), q), rotate(f, compose(q, r))), 1e-13);
}

TEST(rotation, energy_per_degree_stays) {
  const Coefficients f = random_coefficients(60, 2);
  const auto before = power_spectrum(f), after = power_spectrum(rotate(f, random_rotation(9)));
  for (int l = 0; l <= 60; ++l) EXPECT_NEAR(after[l], before[l], 1e-13 * before[l]) << l;
}

TEST(rotation, none_changes_nothing_and_about_z_no_zonal_part) {
  const Coefficients f = random_coefficients(30, 3);
  EXPECT_LT(relative_difference(rotate(f, {}), f), 1e-16);
  const Coefficients g = rotate(f, rotation_about({0, 0, 1}, 0.4));
  for (int l = 0; l <= 30; ++l) EXPECT_EQ(g.c(l, 0), f.c(l, 0));
}

TEST(rotation, is_the_same_for_any_number_of_threads) {
  const Coefficients f = random_coefficients(90, 3);
  const Rotation r = random_rotation(1);
  const Coefficients one = rotate(f, r, {.threads = 1}), two = rotate(f, r, {.threads = 2});
  EXPECT_TRUE(std::ranges::equal(one.values(), two.values()));
}

TEST(rotation, of_an_expansion_moves_its_centre) {
  const Rotation r = rotation_about({0, 0, 1}, kPi / 2);
  Expansion e = expansion_of(random_coefficients(4, 1), {2, 0, 1});
  e.method = "edge";
  e.errors.emplace();
  e.errors->rms = 0.5;
  e.errors->diagonal = 3;
  const Expansion turned = rotate(e, r);
  expect_near(turned.center, {0, 2, 1}, 1e-15);
  EXPECT_EQ(rotate(turned, r).method, "edge, rotated");
  EXPECT_EQ(turned.errors->rms, 0.5);
  EXPECT_EQ(turned.errors->diagonal, 0);  // the diagonal belongs to another box
  expect_near(rotate(e, r, e.center).center, e.center, 0);
}

TEST(mirror, values_are_those_at_the_mirrored_directions) {
  const Coefficients f = random_coefficients(17, 4);
  const std::vector<Vec3> to = random_directions(50, 3);
  for (const Axis axis : {Axis::kX, Axis::kY, Axis::kZ}) {
    std::vector<Vec3> from = to;
    for (Vec3& u : from) {
      (axis == Axis::kX ? u.x : axis == Axis::kY ? u.y : u.z) *= -1;
    }
    const auto a = evaluate(f, from, {.engine = Engine::kDirect});
    const auto b = evaluate(mirror(f, axis), to, {.engine = Engine::kDirect});
    for (std::size_t i = 0; i < to.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-12);
    EXPECT_TRUE(std::ranges::equal(mirror(mirror(f, axis), axis).values(), f.values()));
  }
}

TEST(mirror, all_three_axes_are_the_point_image) {
  const Coefficients f = random_coefficients(9, 4);
  const Coefficients g = mirror(mirror(mirror(f, Axis::kX), Axis::kY), Axis::kZ);
  for (int l = 0; l <= 9; ++l) {
    for (int m = 0; m <= l; ++m) EXPECT_EQ(g.c(l, m), (l % 2 == 0 ? 1 : -1) * f.c(l, m));
  }
}

TEST(mirror, of_an_expansion_moves_its_centre) {
  const Expansion e = expansion_of(Coefficients(1), {2, 3, 1});
  EXPECT_EQ(mirror(e, Axis::kY).center, (Vec3{2, -3, 1}));
  EXPECT_EQ(mirror(e, Axis::kX, {1, 0, 0}).center, (Vec3{0, 3, 1}));
}

}  // namespace
}  // namespace rholm
