#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "rholm/primitives.h"
#include "rholm/star.h"
#include "rholm/transform.h"
#include "support/dense_error.h"
#include "support/sizes.h"
#include "support/test_shapes.h"
#include "transform/error/error_of_degree.h"
#include "transform/tolerance/tolerance.h"

namespace rholm {
namespace {

StarChart chart_of(const Mesh& mesh) {
  return make_star_chart(mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
}

std::vector<Tolerance> tolerances() {
  std::vector<Tolerance> all;
  for (const ErrorNorm norm : {ErrorNorm::kRms, ErrorNorm::kMax}) {
    for (const ErrorMeasure measure : {ErrorMeasure::kRadius, ErrorMeasure::kDistance}) {
      for (const double error : {1e-1, 1e-2}) {
        all.push_back({.error = error, .norm = norm, .measure = measure, .max_degree = 100});
      }
    }
  }
  return all;
}

// Degrees are doubled until one is good; then the final degree is computed.
TEST_OF_TWO_SIZES(search_tolerance, doubles_the_degree_until_it_is_good) {
  std::vector<Mesh> meshes = {test::rotated(bumpy_sphere(3, 0.3))};
  if (nightly) meshes.push_back(box({2, 1.6, 1.2}));
  for (const Mesh& mesh : meshes) {
    const StarChart chart = chart_of(mesh);
    for (const Tolerance& tolerance : tolerances()) {
      const ToleranceTransform found = expand(chart, tolerance);
      const std::vector<int>& degrees = found.degrees;
      ASSERT_GE(degrees.size(), 2u);
      EXPECT_EQ(degrees[0], first_degree(mesh.faces.size(), tolerance));
      const auto is_next = [&](int a, int b) {
        return b > a && b == std::min(2 * (a + 1), tolerance.max_degree);
      };
      const auto last = std::adjacent_find(degrees.begin(), degrees.end(),
                                           [&](int a, int b) { return !is_next(a, b); });
      // All later degrees are final ones: the first of them may have to be raised slightly.
      ASSERT_NE(last, degrees.end());
      EXPECT_LE(degrees.end() - last, 3);
      for (auto it = last + 1; it != degrees.end(); ++it) EXPECT_LE(*it, 1.03 * *last + 1);
      // The last degree before the good one was not sufficient.
      if (last != degrees.begin() && found.met) {
        EXPECT_GT(*(last + 1), *(last - 1));
      }
    }
  }
}

// The oracle is Parseval with coefficients far more precise than the tolerance.
TEST(search_tolerance, finds_the_smallest_degree_exactly_for_the_rms_radius) {
  for (const Mesh& mesh : {box({2, 1.6, 1.2}), test::rotated(bumpy_sphere(3, 0.3))}) {
    const StarChart chart = chart_of(mesh);
    const Transform exact = expand(chart, {.degree = 150, .precision = 1e-12});
    for (const double error : {0.2, 3e-2, 3e-3}) {
      const ToleranceTransform found = expand(chart, Tolerance{.error = error, .max_degree = 150});
      ASSERT_TRUE(found.met);
      const int degree = found.transform.expansion.coefficients.degree();
      const auto tail = [&](int l) {
        const Coefficients first = exact.expansion.coefficients.resized(l);
        double rest = *exact.expansion.norm_squared;
        for (const double c : first.values()) rest -= c * c;
        return std::sqrt(rest / (4 * std::numbers::pi));
      };
      EXPECT_NEAR(found.reached, tail(degree), 1e-3 * error);
      EXPECT_LE(tail(degree), 1.001 * error);
      if (degree > 0) {
        EXPECT_GT(tail(degree - 1), 0.999 * error);
      }
    }
  }
}

// Largest errors need not fall with every degree. Each lower degree is measured in dense points
// and, where these are within the tolerance, uphill of them.
TEST_OF_TWO_SIZES(search_tolerance, finds_the_smallest_degree_for_the_largest_radial_error) {
  std::vector<Mesh> meshes = {test::random_octahedron(4)};
  if (nightly) {
    meshes.insert(meshes.end(), {test::rotated(box({2, 1.6, 0.3})), test::rough_sphere(1),
                                 test::rotated(bumpy_sphere(2, 0.3))});
  }
  for (const Mesh& mesh : meshes) {
    const StarChart chart = chart_of(mesh);
    const Transform exact = expand(chart, {.degree = 100, .precision = 1e-10});
    const int n = mesh.faces.size() > 100 ? 8 : 24;
    for (const double error : nightly ? std::vector{0.2, 0.08} : std::vector{0.12}) {
      Tolerance tolerance{.error = error, .norm = ErrorNorm::kMax, .max_degree = 100};
      const ToleranceTransform found = expand(chart, tolerance);
      ASSERT_TRUE(found.met) << mesh.faces.size() << ' ' << found.reached;
      const int degree = found.transform.expansion.coefficients.degree();
      const auto largest = [&](int l, int rounds) {
        return test::largest_error_of_dense_points(mesh, exact.expansion.coefficients.resized(l), n,
                                                   rounds);
      };
      EXPECT_NEAR(found.reached, largest(degree, 150), 1e-3 * error);
      for (int l = 0; l < degree; ++l) {
        const double points = largest(l, 0);
        EXPECT_GT(points > error ? points : largest(l, 150), 0.9995 * error)
            << l << " of " << degree;
      }
      for (const int most : {degree, degree + 1, degree + 9}) {
        tolerance.max_degree = most;
        EXPECT_EQ(expand(chart, tolerance).transform.expansion.coefficients.degree(), degree);
      }
    }
  }
}

// Distances of a thin box do not fall with every degree. Each lower degree must have a larger
// error, as measured for the model of that degree, whatever the largest degree is.
struct DistanceCase {
  Mesh mesh;
  double largest, rms;
};
TEST_OF_TWO_SIZES(search_tolerance, finds_the_smallest_degree_for_distances) {
  std::vector<DistanceCase> shapes = {{test::rotated(box({2, 1.6, 0.2})), 0.15, 0.06}};
  if (nightly) {
    shapes = {{test::rotated(box({2, 1.6, 0.2})), 0.05, 0.02},
              {test::rotated(bumpy_sphere(3, 0.3)), 0.04, 0.01}};
  }
  for (const DistanceCase& shape : shapes) {
    const StarChart chart = chart_of(shape.mesh);
    // Models of the degrees 0, 1, ...: one measurement gives the errors of all norms.
    std::vector<TruncationErrors> errors;
    const auto errors_of = [&](int degree) {
      while (std::ssize(errors) <= degree) {
        const Transform lower = expand(chart, {.degree = static_cast<int>(errors.size())});
        errors.push_back(truncation_errors(view_of(shape.mesh), lower.expansion));
      }
      return errors[static_cast<std::size_t>(degree)];
    };
    for (const ErrorNorm norm : {ErrorNorm::kMax, ErrorNorm::kRms}) {
      if (!nightly && norm == ErrorNorm::kRms) continue;
      Tolerance tolerance{.error = norm == ErrorNorm::kMax ? shape.largest : shape.rms,
                          .norm = norm,
                          .measure = ErrorMeasure::kDistance,
                          .max_degree = 100};
      const ToleranceTransform found = expand(chart, tolerance);
      ASSERT_TRUE(found.met);
      const int degree = found.transform.expansion.coefficients.degree();
      for (int l = 0; l < degree; ++l) {
        const double error = error_in(errors_of(l), tolerance);
        EXPECT_GT(error, tolerance.error) << to_string(norm) << ' ' << l << " of " << degree;
      }
      for (const int most : {degree, degree + 1, degree + 9}) {
        if (!nightly && most == degree + 9) continue;
        tolerance.max_degree = most;
        EXPECT_EQ(expand(chart, tolerance).transform.expansion.coefficients.degree(), degree)
            << to_string(norm) << ' ' << most;
      }
    }
  }
}

TEST(search_tolerance, ends_with_the_largest_degree_where_none_is_good_nightly) {
  const StarChart chart = chart_of(box({2, 1.6, 1.2}));
  for (Tolerance tolerance : tolerances()) {
    tolerance.error = 1e-6;
    for (const int most : {0, 20}) {
      tolerance.max_degree = most;
      const ToleranceTransform found = expand(chart, tolerance);
      EXPECT_FALSE(found.met);
      EXPECT_EQ(found.transform.expansion.coefficients.degree(), most);
      EXPECT_GT(found.reached, found.allowed);
    }
  }
}

}  // namespace
}  // namespace rholm
