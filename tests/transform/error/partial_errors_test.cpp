#include "transform/error/partial_errors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rholm/harmonic.h"
#include "support/random_data.h"

namespace rholm {
namespace {

constexpr int kDegree = 40;

Coefficients random_coefficients() {
  Coefficients c(kDegree);
  for (int l = 0; l <= kDegree; ++l) {
    for (int m = 0; m <= l; ++m) {
      c.c(l, m) = test::random_in(-1, 1, 1, static_cast<std::uint64_t>(100 * l + m));
      if (m > 0) c.s(l, m) = test::random_in(-1, 1, 2, static_cast<std::uint64_t>(100 * l + m));
    }
  }
  return c;
}

// Compares with separate sums up to each degree, also at the poles.
TEST(largest_partial_errors, are_those_of_the_first_degrees) {
  const Coefficients c = random_coefficients();
  ErrorPoints points;
  for (const Vec3& x :
       {Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{1e-9, 0, 1}, Vec3{-1, 2, 0.3}, Vec3{0.1, -0.2, -3}}) {
    points.add(x / norm(x), 0.5 + static_cast<double>(points.size()), 0, 0);
  }
  const std::vector<double> found = largest_partial_errors(points, c, {.threads = 3});
  ASSERT_EQ(found.size(), static_cast<std::size_t>(kDegree + 1));
  EXPECT_EQ(found, largest_partial_errors(points, c, {.threads = 1}));
  for (int l = 0; l <= kDegree; ++l) {
    const std::vector<double> values =
        evaluate(c.resized(l), points.directions, {.engine = Engine::kDirect});
    double most = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      most = std::max(most, std::abs(points.radii[i] - values[i]));
    }
    EXPECT_NEAR(found[static_cast<std::size_t>(l)], most, 1e-11) << l;
  }
}

// Compares with separate gradients up to each degree.
TEST(largest_partial_distances, are_those_to_the_tangent_planes_of_the_first_degrees) {
  const Coefficients c = random_coefficients();
  ErrorPoints points;
  for (const Vec3& x : {Vec3{1, 0, 0}, Vec3{-1, 2, 0.3}, Vec3{0.1, -0.2, -3}, Vec3{1e-3, 0, 1}}) {
    points.add(x / norm(x), 0.5 + static_cast<double>(points.size()), 0, 0);
  }
  const std::vector<double> found = largest_partial_distances(points, c, {.threads = 3});
  EXPECT_EQ(found, largest_partial_distances(points, c, {.threads = 1}));
  ASSERT_EQ(found.size(), static_cast<std::size_t>(kDegree + 1));
  for (int l = 0; l <= kDegree; ++l) {
    const ValuesAndGradients model =
        evaluate_with_gradient(c.resized(l), points.directions, {.engine = Engine::kDirect});
    double most = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double r = model.values[i];
      const Vec3 normal = normalized(r * points.directions[i] - model.gradients[i]);
      most = std::max(most, std::abs((points.radii[i] - r) * dot(points.directions[i], normal)));
    }
    EXPECT_NEAR(found[static_cast<std::size_t>(l)], most, 1e-10) << l;
  }
}

}  // namespace
}  // namespace rholm
