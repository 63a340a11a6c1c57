#include "rholm/align.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "harmonic/motion/align_newton.h"
#include "rholm/error.h"
#include "rholm/grid.h"
#include "rholm/harmonic.h"
#include "rholm/recenter.h"
#include "support/random_data.h"

namespace rholm {
namespace {

using test::random_coefficients;
using test::random_direction;
using test::random_in;
using test::relative_difference;

constexpr double kPi = std::numbers::pi;
constexpr double kDegrees = kPi / 180;

Rotation random_rotation(std::uint64_t seed) {
  return rotation_about(random_direction(seed, 0), random_in(0, 2 * kPi, seed, 99));
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

// Returns a bumpy body of mean radius 1, whose coefficients of degree l fall like l^-2.
Coefficients body(int degree, std::uint64_t seed) {
  Coefficients f = random_coefficients(degree, seed);
  for (int l = 1; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      f.c(l, m) *= 0.2 / (l * l);
      f.s(l, m) *= 0.2 / (l * l);
    }
  }
  f.c(0, 0) = std::sqrt(4 * kPi);
  return f;
}

// Adds white noise of this rms: independent noise of equal variance in every coefficient.
Coefficients with_noise(const Coefficients& f, double rms, std::uint64_t seed) {
  Coefficients noise = random_coefficients(f.degree(), seed);
  double square = 0;
  for (const double value : noise.values()) square += value * value;
  const double factor = rms * std::sqrt(4 * kPi / square);
  for (std::size_t i = 0; i < noise.values().size(); ++i) {
    noise.values()[i] = f.values()[i] + factor * noise.values()[i];
  }
  return noise;
}

// Expands the sum of u^T A u on the sphere exactly, by quadrature.
Coefficients quadratic_form(const std::array<double, 3>& squares, double mean) {
  const GaussRule rule = gauss_legendre(6);
  std::vector<Vec3> directions;
  std::vector<double> weights;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    for (int k = 0; k < 12; ++k) {
      const double z = rule.nodes[i], s = std::sqrt(1 - z * z), phi = 2 * kPi * k / 12;
      const Vec3 u = {s * std::cos(phi), s * std::sin(phi), z};
      directions.push_back(u);
      weights.push_back(
          rule.weights[i] * 2 * kPi / 12 *
          (mean + squares[0] * u.x * u.x + squares[1] * u.y * u.y + squares[2] * u.z * u.z));
    }
  }
  Coefficients f(4);
  add_adjoint({.directions = directions, .weights = weights}, f, {.engine = Engine::kDirect});
  return f;
}

TEST(align, derivatives_are_those_of_small_rotations) {
  const Coefficients f = random_coefficients(9, 1);
  const auto derivatives = rotation_derivatives(f);
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const double h = 1e-4;
  for (int k = 0; k < 3; ++k) {
    const Coefficients ahead = rotate(f, rotation_about(axes[k], h)),
                       behind = rotate(f, rotation_about(axes[k], -h));
    Coefficients slope(9);
    for (std::size_t i = 0; i < slope.values().size(); ++i) {
      slope.values()[i] = (ahead.values()[i] - behind.values()[i]) / (2 * h);
    }
    // Central differences have the error (L h)^2 / 6.
    EXPECT_LT(relative_difference(slope, derivatives[k]), 81 * h * h / 3 + 1e-10) << k;
  }
}

TEST(align, derivatives_are_antisymmetric) {
  const Coefficients f = random_coefficients(12, 1), g = random_coefficients(12, 2);
  const auto of_f = rotation_derivatives(f), of_g = rotation_derivatives(g);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(correlation(of_f[k], g), -correlation(f, of_g[k]), 1e-11);
  }
}

TEST(align, eigenvectors_of_a_turned_diagonal_are_found) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const RotationMatrix m = matrix_of(random_rotation(seed));
    const double values[3] = {3, seed % 3 == 0 ? 3.0 : -1.0, -1e-8};
    std::array<std::array<double, 3>, 3> a{};
    const auto at = [](const Vec3& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; };
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        for (int n = 0; n < 3; ++n) a[i][k] += values[n] * at(m[n], i) * at(m[n], k);
      }
    }
    const Eigen3 eigen = eigen_of_symmetric(a);
    EXPECT_NEAR(eigen.values[0], 3, 1e-14);
    EXPECT_NEAR(dot(eigen.vectors[0], cross(eigen.vectors[1], eigen.vectors[2])), 1, 1e-14);
    for (int n = 0; n < 3; ++n) {
      const Vec3& v = eigen.vectors[n];
      for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(a[i][0] * v.x + a[i][1] * v.y + a[i][2] * v.z, eigen.values[n] * at(v, i),
                    1e-14);
      }
    }
  }
}

TEST(align, a_turned_copy_is_turned_back_exactly) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Coefficients a = body(24, seed);
    const Rotation truth = random_rotation(seed + 70);
    for (const AlignStart start : {AlignStart::kCorrelation, AlignStart::kPrincipalAxes}) {
      const Alignment found = align(a, rotate(a, truth), {.start = start});
      // The correlation is flat at its maximum: angles have the square root of rounding; Newton
      // improves.
      EXPECT_LT(angle_between(found.best.rotation, truth), 1e-7) << seed;
      EXPECT_LT(found.best.distance, 1e-7);
      EXPECT_NEAR(found.best.correlation, 1, 1e-12);
      EXPECT_TRUE(found.ambiguities.empty());
      EXPECT_TRUE(found.free_axes.empty());
    }
  }
}

// White noise of variance s^2 per coefficient gives the angles the covariance s^2 times the inverse
// curvature (Cramer and Rao). The bound is four standard deviations of all three angles together.
TEST(align, a_noisy_copy_is_found_as_well_as_the_noise_allows) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Coefficients a = body(32, seed);
    const Rotation truth = random_rotation(seed + 70);
    const Coefficients b = with_noise(rotate(a, truth), 0.01, seed + 1000);
    const Alignment found = align(a, b);
    const Coefficients turned = rotate(a, truth);
    const Eigen3 curvature = refine_rotation(turned, turned, {}, {}).curvature;
    double variance = 0;
    for (const double value : curvature.values) variance += 1e-4 * 4 * kPi / (33 * 33) / value;
    EXPECT_LT(angle_between(found.best.rotation, truth), 4 * std::sqrt(variance)) << seed;
    EXPECT_NEAR(found.best.distance, 0.01, 0.001);
  }
}

TEST(align, small_and_large_rotations_alike) {
  const Coefficients a = body(16, 3);
  for (const Rotation& truth :
       {Rotation{}, rotation_about({0, 0, 1}, kPi), rotation_about({0, 1, 0}, kPi),
        rotation_about({1, 1, 0}, 1e-6), rotation_about({1, 2, 3}, kPi - 1e-9)}) {
    EXPECT_LT(angle_between(align(a, rotate(a, truth)).best.rotation, truth), 1e-7);
  }
}

TEST(align, different_degrees_are_compared_as_if_filled_with_zeros) {
  const Coefficients a = body(30, 3);
  const Rotation truth = random_rotation(2);
  const Coefficients b = rotate(a, truth).resized(12);
  const Alignment found = align(a, b);
  EXPECT_LT(angle_between(found.best.rotation, truth), 1e-6);
  double square = 0;
  const auto energy = power_spectrum(a);
  for (int l = 13; l <= 30; ++l) square += energy[l];
  EXPECT_NEAR(found.best.distance, std::sqrt(square / (4 * kPi)), 1e-9);
}

TEST(align, an_ellipsoid_has_four_ways_to_lie) {
  const Coefficients a = quadratic_form({1, 0.5, 0.2}, 1);
  const Rotation truth = random_rotation(6);
  const Alignment found = align(a, rotate(a, truth));
  ASSERT_EQ(found.ambiguities.size(), 3u);
  EXPECT_TRUE(found.free_axes.empty());
  std::vector<Rotation> all = {found.best.rotation};
  for (const AlignedRotation& r : found.ambiguities) {
    EXPECT_NEAR(r.correlation, 1, 1e-12);
    EXPECT_LT(r.distance, 1e-7);
    all.push_back(r.rotation);
  }
  // The results are the true rotation after half turns about the body's axes, here x, y and z.
  for (const Rotation& half :
       {Rotation{}, Rotation{0, 1, 0, 0}, Rotation{0, 0, 1, 0}, Rotation{0, 0, 0, 1}}) {
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const Rotation& r) {
      return angle_between(r, compose(truth, half)) < 1e-6;
    }));
  }
}

// The invariant of the group of a cube: 24 rotations and 24 reflections are equally good.
TEST(align, of_equally_good_rotations_the_smallest_is_best) {
  Coefficients cubic(4);
  cubic.c(0, 0) = 1;
  cubic.c(4, 0) = std::sqrt(7. / 12);
  cubic.c(4, 4) = std::sqrt(5. / 12);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Coefficients f = rotate(cubic, random_rotation(seed));
    const Alignment still = align(f, f, {.mirror = seed % 2 == 0});
    EXPECT_LT(angle_between(still.best.rotation, {}), 1e-6) << seed;
    EXPECT_FALSE(still.best.mirrored);
    EXPECT_GE(still.ambiguities.size(), 23u);
    const Rotation small = rotation_about(random_direction(seed, 1), 20 * kDegrees);
    EXPECT_LT(angle_between(align(f, rotate(f, small)).best.rotation, small), 1e-6) << seed;
  }
}

TEST(align, a_surface_of_revolution_turns_freely_about_its_axis) {
  Coefficients a(6);
  a.c(0, 0) = 3, a.c(1, 0) = 0.4, a.c(2, 0) = 0.5, a.c(3, 0) = -0.3;
  const Rotation truth = random_rotation(6);
  const Alignment found = align(a, rotate(a, truth));
  const Vec3 axis = rotate({0, 0, 1}, truth);
  ASSERT_EQ(found.free_axes.size(), 1u);
  EXPECT_NEAR(std::abs(dot(found.free_axes[0], axis)), 1, 1e-9);
  EXPECT_LT(norm(rotate({0, 0, 1}, found.best.rotation) - axis), 1e-7);
  EXPECT_TRUE(found.ambiguities.empty());
}

TEST(align, spheres_turn_freely) {
  Coefficients sphere(5);
  sphere.c(0, 0) = 2;
  for (const Coefficients& other : {sphere, body(5, 1), Coefficients(0), Coefficients(3)}) {
    const Alignment found = align(sphere, other);
    EXPECT_EQ(found.free_axes.size(), 3u);
    EXPECT_EQ(found.best.rotation.w, 1);
    EXPECT_DOUBLE_EQ(found.best.distance, distance(sphere, other));
  }
}

TEST(align, a_mirror_image_is_another_body) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const Coefficients a = body(20, seed);
    const Coefficients image = rotate(mirror(a, Axis::kY), random_rotation(seed + 9));
    const Alignment strict = align(a, image);
    EXPECT_LT(strict.best.correlation, 0.99);
    EXPECT_GT(strict.best.distance, 0.01);
    const Alignment both = align(a, image, {.mirror = true});
    EXPECT_TRUE(both.best.mirrored);
    EXPECT_LT(both.best.distance, 1e-7);
    const Coefficients laid = rotate(mirror(a, Axis::kX), both.best.rotation);
    EXPECT_LT(relative_difference(laid, image), 1e-7);
    // No reflection is reported where a rotation suffices.
    const Alignment plain = align(a, rotate(a, random_rotation(seed)), {.mirror = true});
    EXPECT_FALSE(plain.best.mirrored);
    EXPECT_TRUE(plain.ambiguities.empty());
  }
}

TEST(align, descriptors_bound_the_distance_and_do_not_turn) {
  const Coefficients a = body(20, 1), b = body(20, 2);
  EXPECT_LT(descriptor_distance(a, rotate(a, random_rotation(1))), 1e-14);
  EXPECT_LE(descriptor_distance(a, b), align(a, b).best.distance);
  EXPECT_GT(descriptor_distance(a, b), 0);
}

TEST(align, distance_is_the_root_mean_square_over_the_sphere) {
  Coefficients a(0), b(3);
  a.c(0, 0) = 3 * std::sqrt(4 * kPi);
  b.c(0, 0) = 1 * std::sqrt(4 * kPi);
  EXPECT_DOUBLE_EQ(distance(a, b), 2);
  a.c(0, 0) = 1e200, b.c(0, 0) = -1e200;
  EXPECT_DOUBLE_EQ(distance(a, b), 2e200 / std::sqrt(4 * kPi));
  EXPECT_EQ(distance(Coefficients(1), Coefficients(2)), 0);
}

TEST(align, size_does_not_matter) {
  Coefficients a = body(12, 1);
  const Rotation truth = random_rotation(3);
  const Coefficients b = rotate(a, truth);
  for (const double size : {1e-200, 1e200}) {
    Coefficients scaled = a;
    for (double& value : scaled.values()) value *= size;
    EXPECT_LT(angle_between(align(scaled, b).best.rotation, truth), 1e-7);
  }
}

TEST(align, principal_axes_of_a_turned_ellipsoid_are_its_axes) {
  const Rotation truth = random_rotation(6);
  const Coefficients f = rotate(quadratic_form({0.5, 1, 0.2}, 1), truth);
  const PrincipalAxes found = principal_axes(f);
  const Vec3 expected[3] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};  // longest axis first
  const double mean = 1.7 / 3;
  const double values[3] = {1 - mean, 0.5 - mean, 0.2 - mean};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::abs(dot(found.axes[i], rotate(expected[i], truth))), 1, 1e-13);
    EXPECT_NEAR(found.values[i], values[i], 1e-13);
  }
  const PrincipalAxes again = principal_axes(rotate(f, found.to_axes));
  EXPECT_NEAR(std::abs(again.axes[0].x), 1, 1e-13);
  EXPECT_NEAR(std::abs(again.axes[1].y), 1, 1e-13);
  // 1/r is smallest where r is largest.
  EXPECT_NEAR(principal_axes(f, RadialFunction::kGauge).values[0], -values[2], 1e-13);
}

TEST(align, principal_axes_follow_the_body_with_their_signs) {
  const Coefficients a = body(8, 5);
  const PrincipalAxes before = principal_axes(a);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Rotation r = random_rotation(seed);
    const PrincipalAxes after = principal_axes(rotate(a, r));
    for (int i = 0; i < 3; ++i) {
      EXPECT_LT(norm(after.axes[i] - rotate(before.axes[i], r)), 1e-12) << i;
    }
  }
}

// Degrees 1 ... 5 of an icosphere vanish except for rounding.
TEST(align, principal_axes_of_a_sphere_turn_nothing_and_are_free) {
  Coefficients sphere = random_coefficients(8, 3);
  for (double& value : sphere.values()) value *= 1e-14;
  sphere.c(0, 0) = std::sqrt(4 * kPi);
  const PrincipalAxes found = principal_axes(sphere);
  EXPECT_EQ(found.free_axes.size(), 3u);
  EXPECT_EQ(angle_between(found.to_axes, {}), 0);
  EXPECT_EQ(found.axes[0], (Vec3{1, 0, 0}));
}

TEST(align, principal_axes_of_a_body_of_revolution_take_the_smallest_turn) {
  const Vec3 axis = normalized({0.3, -0.2, 0.9});
  for (const double along : {0.5, 2.0}) {  // oblate: axis to z; prolate: axis to x
    const Rotation turn = rotation_about(cross({0, 0, 1}, axis), std::acos(axis.z));
    const PrincipalAxes found = principal_axes(rotate(quadratic_form({1, 1, along}, 1), turn));
    ASSERT_EQ(found.free_axes.size(), 1u) << along;
    EXPECT_NEAR(std::abs(dot(found.free_axes[0], axis)), 1, 1e-12);
    const Vec3 target = along < 1 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    EXPECT_NEAR(norm(rotate(axis, found.to_axes) - target), 0, 1e-12);
    EXPECT_NEAR(angle_between(found.to_axes, {}), std::acos(dot(axis, target)), 1e-12);
  }
}

// The body is oblate, and its degree 3 makes -z the positive end: half a turn moves it to z.
TEST(align, principal_axes_of_a_body_upside_down_turn_it_half_way) {
  Coefficients body = quadratic_form({1, 1, 0.5}, 1).resized(3);
  body.c(3, 0) = -0.1;
  const PrincipalAxes found = principal_axes(body);
  ASSERT_EQ(found.free_axes.size(), 1u);
  EXPECT_NEAR(norm(found.free_axes[0] - Vec3{0, 0, -1}), 0, 1e-15);
  EXPECT_NEAR(norm(rotate(Vec3{0, 0, -1}, found.to_axes) - Vec3{0, 0, 1}), 0, 1e-15);
  EXPECT_NEAR(angle_between(found.to_axes, {}), kPi, 1e-12);
}

TEST(align, what_is_laid_on_itself_stays_whatever_its_symmetries) {
  // Degree 4 of a cube has 48 rotations and reflections.
  Coefficients cube(4);
  cube.c(0, 0) = 4;
  cube.c(4, 0) = 0.1 * std::sqrt(7.0);
  cube.c(4, 4) = 0.1 * std::sqrt(5.0);
  EXPECT_LT(angle_between(align(cube, cube).best.rotation, {}), 1e-9);
}

Expansion expansion_of(const Coefficients& coefficients, const Vec3& center) {
  Expansion expansion;
  expansion.coefficients = coefficients;
  expansion.center = center;
  return expansion;
}

TEST(align, what_is_not_known_of_a_round_surface_makes_it_a_sphere) {
  Expansion nearly_round = expansion_of(Coefficients(6), {});
  nearly_round.coefficients.c(0, 0) = std::sqrt(4 * kPi);
  nearly_round.coefficients.c(6, 3) = 1e-5 * std::sqrt(4 * kPi);
  for (const double left_out : {0.9e-5, 1.1e-5}) {
    nearly_round.errors.emplace().rms = left_out;
    for (const AlignCenters centers : {AlignCenters::kOwn, AlignCenters::kVolume}) {
      const Alignment found = align(nearly_round, nearly_round, centers).alignment;
      EXPECT_EQ(found.free_axes.size(), left_out > 1e-5 ? 3u : 0u);
      EXPECT_LT(angle_between(found.best.rotation, {}), 1e-6);
    }
  }
}

TEST(align, laid_on_the_other_by_their_own_centres) {
  const Rotation truth = random_rotation(3);
  const Expansion a = expansion_of(body(10, 1), {5, 0, 0});
  const Expansion b = expansion_of(rotate(mirror(a.coefficients, Axis::kZ), truth), {1, 2, 3});
  const Placement found = align(a, b, AlignCenters::kOwn, {.mirror = true});
  const Expansion laid = placed(a, found);
  EXPECT_LT(norm(laid.center - b.center), 1e-14);
  EXPECT_LT(relative_difference(laid.coefficients, b.coefficients), 1e-7);
  Expansion gauge = b;
  gauge.function = RadialFunction::kGauge;
  expect_refused([&] { align(a, gauge, AlignCenters::kOwn); });
}

// Both expansions describe the same solid about different centres.
TEST(align, by_centroids_the_centres_of_the_expansions_do_not_matter) {
  const Rotation truth = random_rotation(3);
  Expansion a = expansion_of(body(12, 1).resized(40), {5, 0, 0});
  const Expansion b = recentered(rotate(a, truth, {1, 1, 1}),
                                 rotate(Vec3{5, 0, 0} - Vec3{1, 1, 1}, truth) + Vec3{1.1, 0.9, 1});
  const Placement found = align(a, b, AlignCenters::kVolume);
  // The degrees above 40 are lost in b; they have some 1e-6.
  EXPECT_LT(angle_between(found.alignment.best.rotation, truth), 1e-4);
  EXPECT_LT(found.alignment.best.distance, 1e-5);
  const Expansion laid = placed(a, found);
  EXPECT_LT(norm(laid.center - (rotate(Vec3{4, -1, -1}, truth) + Vec3{1, 1, 1})), 1e-5);
}

// A small ball with a long horn that contains the centroid. The sides of the ball cannot be seen
// from the centroid.
Coefficients horned() {
  const Grid grid = smallest_grid(GridKind::kGaussLegendre, 40);
  std::vector<double> values;
  for (const double theta : grid_colatitudes(grid)) {
    for (int k = 0; k < grid.n_phi; ++k) {
      const double x = std::sin(theta) * std::cos(2 * kPi * k / grid.n_phi);
      values.push_back(0.4 + 0.1 * x + 3 * std::exp(40 * (std::cos(theta) - 1)));
    }
  }
  return analyze_grid(values, grid, 40);
}

TEST(align, takes_own_centres_where_a_centroid_does_not_see_the_surface_and_says_so) {
  const Rotation truth = random_rotation(5);
  Expansion a = expansion_of(body(12, 1), {5, 0, 0});
  EXPECT_EQ(align(a, a, AlignCenters::kAuto).centers, AlignCenters::kVolume);
  EXPECT_TRUE(align(a, a, AlignCenters::kAuto).why_own.empty());
  a.coefficients = horned();
  const Expansion b = rotate(a, truth, {1, 1, 1});
  EXPECT_THROW(align(a, b, AlignCenters::kVolume), Error);
  const Placement found = align(a, b, AlignCenters::kAuto);
  EXPECT_EQ(found.centers, AlignCenters::kOwn);
  EXPECT_FALSE(found.why_own.empty());
  EXPECT_LT(norm(placed(a, found).center - b.center), 1e-12);
  EXPECT_LT(angle_between(found.alignment.best.rotation, truth), 1e-4);
}

// From a point at the offset d a unit sphere is at rho = -d.u + sqrt(1 - |d|^2 + (d.u)^2).
TEST(recenter, a_sphere_from_another_point_has_its_closed_form) {
  Expansion sphere = expansion_of(Coefficients(40), {1, 2, 3});
  for (const RadialFunction function : {RadialFunction::kRadius, RadialFunction::kGauge}) {
    sphere.function = function;
    sphere.coefficients.c(0, 0) = std::sqrt(4 * kPi);
    const Vec3 d = {0.3, -0.2, 0.1};
    const Expansion moved = recentered(sphere, sphere.center + d);
    const auto directions = test::random_directions(200, 5);
    const auto values = evaluate(moved.coefficients, directions);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double along = dot(d, directions[i]);
      const double rho = -along + std::sqrt(1 - dot(d, d) + along * along);
      // The series in |d| = 0.37 falls like 0.37^l.
      EXPECT_NEAR(values[i], function == RadialFunction::kGauge ? 1 / rho : rho, 1e-11);
    }
    EXPECT_LT(norm(volume_centroid(moved) - sphere.center), 1e-11);
  }
}

TEST(recenter, there_and_back_is_the_same) {
  const Expansion a = expansion_of(body(8, 2).resized(48), {1, 0, 0});
  const Expansion back = recentered(recentered(a, {1.05, 0.03, -0.04}), a.center);
  EXPECT_LT(relative_difference(back.coefficients, a.coefficients), 1e-8);
  EXPECT_EQ(recentered(a, a.center).coefficients.c(3, 2), a.coefficients.c(3, 2));
}

TEST(recenter, centres_from_which_the_surface_is_not_seen_are_refused) {
  const auto code = [](const Expansion& e, const Vec3& center) {
    try {
      recentered(e, center);
    } catch (const Error& error) {
      return error.code();
    }
    return ErrorCode::kIo;
  };
  Expansion e = expansion_of(Coefficients(30), {});  // the grid follows the degree
  e.coefficients.c(0, 0) = std::sqrt(4 * kPi);
  EXPECT_EQ(code(e, {0, 1.5, 0}), ErrorCode::kNotStarShaped);
  // A peanut along z, r = 1 + 0.9 P_2, seen from one end. The other lobe, 0.85 wide at z = -0.71,
  // is partly hidden by the waist, 0.55 wide at z = 0.
  e.coefficients.c(2, 0) = 0.9 * std::sqrt(4 * kPi / 5);
  EXPECT_EQ(code(e, {0, 0, 1.8}), ErrorCode::kNotStarShaped);
  e.coefficients.c(2, 0) *= 10;  // r < 0 on the equator
  EXPECT_EQ(code(e, {0, 0, 0.1}), ErrorCode::kInvalidInput);
  EXPECT_EQ(code(expansion_of(Coefficients(2), {}), {0.1, 0, 0}), ErrorCode::kInvalidInput);
  expect_refused([] { volume_centroid(expansion_of(Coefficients(2), {})); });
  Expansion sum = expansion_of(body(6, 1), {});
  sum.signed_sum = true;
  EXPECT_EQ(code(sum, {0.01, 0, 0}), ErrorCode::kUnsupported);
  EXPECT_THROW(volume_centroid(sum), Error);
  EXPECT_THROW(seen_center(sum, {0.01, 0, 0}), Error);
}

// A ball with a wide upward bulge, which moves the centroid, and a narrow bulge to the side, whose
// series oscillates.
Expansion bulged(int degree, double height, double width) {
  const Grid grid = smallest_grid(GridKind::kGaussLegendre, 96);
  std::vector<double> values;
  for (const double theta : grid_colatitudes(grid)) {
    for (int k = 0; k < grid.n_phi; ++k) {
      const double x = std::sin(theta) * std::cos(2 * kPi * k / grid.n_phi);
      values.push_back(1 + 1.5 * std::exp(4 * (std::cos(theta) - 1)) +
                       height * std::exp((x - 1) / (width * width)));
    }
  }
  return expansion_of(analyze_grid(values, grid, degree), {1, 2, 3});
}

// Returns the rms difference between the surfaces of `moved` and `e`, seen from the centre of `e`.
double rms_apart(const Expansion& moved, const Expansion& e) {
  const auto directions = test::random_directions(400, 3);
  const auto rho = evaluate(moved.coefficients, directions);
  double sum = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Vec3 p = moved.center + rho[i] * directions[i] - e.center;
    const std::vector<Vec3> direction = {normalized(p)};
    const double apart = norm(p) - evaluate(e.coefficients, direction)[0];
    sum += apart * apart / static_cast<double>(directions.size());
  }
  return std::sqrt(sum);
}

TEST(recenter, near_the_centroid_is_possible_at_every_degree) {
  int at_centroid = 0, on_the_way = 0;
  for (const double width : {0.15, 0.25}) {
    for (const double height : {0.5, 1.0, 2.0}) {
      for (int degree = 8; degree <= 26; degree += 3) {
        const Expansion e = bulged(degree, height, width);
        const Vec3 centroid = volume_centroid(e), found = seen_center(e, centroid);
        ++(found == centroid ? at_centroid : on_the_way);
        EXPECT_LT(norm(cross(found - e.center, centroid - e.center)), 1e-12);
        EXPECT_LE(norm(found - e.center), norm(centroid - e.center));
        const Expansion moved = recentered(e, found);
        EXPECT_EQ(moved.center, found);
        EXPECT_LT(rms_apart(moved, e), 0.1) << degree << ' ' << height << ' ' << width;
      }
    }
  }
  EXPECT_GT(at_centroid, 5);
  EXPECT_GT(on_the_way, 5);
}

TEST(recenter, a_point_outside_is_replaced_by_one_inside) {
  const Expansion e = bulged(12, 0.5, 0.25);
  const Vec3 found = seen_center(e, e.center + Vec3{0, 5, 0});
  EXPECT_GT(norm(found - e.center), 0.1);
  EXPECT_LT(norm(found - e.center), 1);
  EXPECT_NO_THROW(recentered(e, found));
  EXPECT_THROW(recentered(e, e.center + Vec3{0, 5, 0}), Error);
}

TEST(align, is_the_same_for_any_number_of_threads) {
  const Coefficients a = body(20, 3), b = with_noise(rotate(a, random_rotation(1)), 0.02, 1);
  const Alignment one = align(a, b, {}, {.threads = 1}), two = align(a, b, {}, {.threads = 2});
  EXPECT_EQ(one.best.rotation.w, two.best.rotation.w);
  EXPECT_EQ(one.best.rotation.x, two.best.rotation.x);
  EXPECT_EQ(one.best.distance, two.best.distance);
}

TEST(align, what_is_out_of_range_is_refused) {
  const Coefficients a = body(4, 1);
  Coefficients bad = a;
  bad.c(1, 0) = std::numeric_limits<double>::quiet_NaN();
  expect_refused([&] { align(a, bad); });
  expect_refused([&] { align(a, a, {.bandwidth = 0}); });
  expect_refused([&] { align(a, a, {.bandwidth = 65}); });
  expect_refused([&] { align(a, a, {.refine_degree = 0}); });
  expect_refused([&] { align(a, a, {.margin = -1}); });
}

}  // namespace
}  // namespace rholm
