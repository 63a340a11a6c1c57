#include "transform/error/error_peaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "rholm/analyze.h"
#include "rholm/harmonic.h"
#include "rholm/primitives.h"
#include "rholm/star.h"
#include "rholm/truncation.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

// A single wave's peak about a direction inside one face, from points that do not have it.
TEST(highest_peaks, are_found_between_points) {
  const Mesh mesh = icosphere(1);
  for (const Vec3& peak : {normalized(Vec3{0.3, 0.4, 0.7}), normalized(Vec3{-0.8, 0.1, 0.2})}) {
    constexpr int kDegree = 12;
    const ErrorAt error = [&](const ErrorPoints& at) {
      std::vector<double> values;
      values.reserve(at.directions.size());
      for (const Vec3& u : at.directions) {
        values.push_back(1 + std::cos(std::min(kDegree * norm(u - peak), 3.14)));
      }
      return values;
    };
    const FaceScan scan = scan_faces(view_of(mesh), Vec3{}, {});
    const ErrorPoints points = extreme_points(view_of(mesh), {}, scan, kDegree);
    const double found = highest_peaks(view_of(mesh), {}, points, {{error(points), error}}, kDegree,
                                       3, {.threads = 1})[0];
    EXPECT_GT(found, 0.999 * 2);
    EXPECT_LE(found, 2);
    EXPECT_LT(largest(error(points)), 0.99 * 2);
  }
}

// Against 400 points on each face.
TEST(truncation_errors, measured_max_is_that_of_dense_points) {
  for (const Mesh& mesh : {test::rotated(bumpy_sphere(2, 0.3)), test::random_octahedron(4),
                           test::rotated(box({2, 1.6, 1.2}))}) {
    const StarChart chart =
        make_star_chart(mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
    for (const int degree : {5, 11, 23}) {
      const Analysis analysis = analyze(chart, {.degree = degree});
      std::vector<Vec3> directions;
      std::vector<double> radii;
      constexpr int n = 28;
      for (const Triangle& t : mesh.triangles) {
        for (int i = 0; i <= n; ++i) {
          for (int j = 0; i + j <= n; ++j) {
            const double a = static_cast<double>(i) / n, b = static_cast<double>(j) / n;
            const Vec3 x = a * mesh.vertices[t[0]] + b * mesh.vertices[t[1]] +
                           (1 - a - b) * mesh.vertices[t[2]];
            radii.push_back(norm(x));
            directions.push_back(x / norm(x));
          }
        }
      }
      const std::vector<double> model = evaluate(analysis.expansion.coefficients, directions);
      double dense = 0;
      for (std::size_t i = 0; i < radii.size(); ++i) {
        dense = std::max(dense, std::abs(radii[i] - model[i]));
      }
      const TruncationErrors errors = truncation_errors(view_of(mesh), analysis.expansion);
      EXPECT_GT(*errors.measured_max, 0.999 * dense) << mesh.triangles.size() << ' ' << degree;
      EXPECT_LT(*errors.measured_max, 1.02 * dense) << mesh.triangles.size() << ' ' << degree;
    }
  }
}

}  // namespace
}  // namespace rholm
