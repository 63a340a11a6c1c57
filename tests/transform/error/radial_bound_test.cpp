#include "transform/error/radial_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "rholm/primitives.h"
#include "rholm/star.h"
#include "rholm/transform.h"
#include "rholm/truncation.h"
#include "support/dense_error.h"
#include "support/sizes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

Expansion expansion_of(const Mesh& mesh, int degree) {
  const StarChart chart =
      make_star_chart(mesh, {.center = {.kind = CenterKind::kNone, .point = {}, .rays = 0}});
  return expand(chart, {.degree = degree, .precision = 1e-9}).expansion;
}

RadialBound bound_of(const Mesh& mesh, const Expansion& expansion, const BoundOptions& options,
                     int threads = 1) {
  const Context context{.threads = threads};
  const MeshView view = view_of(mesh);
  const RadialModel model(expansion, expansion.coefficients.degree(), 100'000, true, 1e-10,
                          context);
  return radial_bound(view, scan_faces(view, {}, context), expansion, model, options, context);
}

Expansion ball(double radius) {
  Expansion expansion;
  expansion.coefficients = Coefficients(0);
  expansion.coefficients.c(0, 0) = radius * std::sqrt(4 * std::numbers::pi);
  return expansion;
}

// Corners are at distance 1 on the axes.
Mesh octahedron() {
  Mesh mesh;
  mesh.faces.reserve(8);
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const std::uint32_t top : {4u, 5u}) {
    for (const auto& [a, b] : {std::pair{0u, 2u}, {2u, 1u}, {1u, 3u}, {3u, 0u}}) {
      if (top == 4) mesh.faces.push_back({a, b, top});
      if (top == 5) mesh.faces.push_back({b, a, top});
    }
  }
  return mesh;
}

// For a spherical model of radius c the errors are 1 - c at vertices and c - 1/sqrt(3) in the
// middle of faces.
TEST(radial_bound, of_an_octahedron_is_its_largest_error) {
  const Mesh mesh = test::rotated(octahedron());
  const double inner = 1 / std::sqrt(3.0);
  for (const double c : {0.65, 0.8, 1.1}) {
    const double exact = std::max(std::abs(1 - c), c - inner);
    const TruncationErrors errors = truncation_errors(view_of(mesh), ball(c));
    ASSERT_TRUE(errors.max_bound.has_value());
    EXPECT_GE(*errors.max_bound, exact) << c;
    EXPECT_LE(*errors.max_bound, 1.0101 * exact) << c;
  }
}

// The error is 1 - d at the foot of the perpendicular to the nearest plane.
TEST(radial_bound, of_a_fine_mesh_of_a_sphere_is_the_depth_of_its_faces) {
  const Mesh mesh = icosphere(4);
  double depth = 0;
  for (const Triangle& t : mesh.faces) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    depth = std::max(depth, 1 - dot(normalized(cross(b - a, c - a)), a));
  }
  const RadialBound bound =
      bound_of(mesh, ball(1), {.seen = depth, .enough = 1.01 * depth, .most_cells = 2'000'000});
  EXPECT_GE(bound.value, depth);
  EXPECT_LE(bound.value, 1.0101 * depth);
  // Uses the number of cells of truncation_errors().
  const TruncationErrors errors = truncation_errors(view_of(mesh), ball(1));
  EXPECT_GE(*errors.max_bound, depth);
  EXPECT_LE(*errors.max_bound, 2.5 * depth);
}

// Compares with other points on all faces.
TEST_OF_TWO_SIZES(radial_bound, no_error_of_random_meshes_is_above_it) {
  for (const Mesh& mesh :
       {test::random_octahedron(4), test::random_octahedron(11), test::rotated(box({2, 1.6, 0.3})),
        test::rough_sphere(1), test::rotated(bumpy_sphere(2, 0.3))}) {
    for (const int degree : nightly ? std::vector{0, 9, 30} : std::vector{0, 9}) {
      const Expansion expansion = expansion_of(mesh, degree);
      const double dense = test::largest_error_of_dense_points(mesh, expansion.coefficients, 14);
      const TruncationErrors errors = truncation_errors(view_of(mesh), expansion);
      ASSERT_TRUE(errors.max_bound.has_value());
      EXPECT_GE(*errors.max_bound, dense) << mesh.faces.size() << ' ' << degree;
      EXPECT_GE(*errors.max_bound, *errors.measured_max);
      EXPECT_LE(*errors.max_bound, (degree < 10 ? 2 : 8) * dense)
          << mesh.faces.size() << ' ' << degree;
      // The bound holds for any number of cells.
      for (const std::size_t most_cells : {0, 10, 1000}) {
        EXPECT_GE(bound_of(mesh, expansion, {.seen = dense, .most_cells = most_cells}).value, dense)
            << mesh.faces.size() << ' ' << degree << ' ' << most_cells;
      }
    }
  }
}

// No error exceeds the measured maximum by more than 1 %, and some error reaches it.
TEST_OF_TWO_SIZES(radial_bound, proves_measured_max_to_a_hundredth) {
  for (const Mesh& mesh :
       {test::random_octahedron(4), test::rotated(box({2, 1.6, 1.2})), test::rough_sphere(1)}) {
    for (const int degree : nightly ? std::vector{6, 14} : std::vector{6}) {
      const Expansion expansion = expansion_of(mesh, degree);
      const double measured = *truncation_errors(view_of(mesh), expansion).measured_max;
      const auto bound = [&](double enough, std::size_t most_cells) {
        return bound_of(mesh, expansion,
                        {.seen = measured, .enough = enough, .most_cells = most_cells});
      };
      const RadialBound above = bound(1.01 * measured, 2'000'000);
      EXPECT_LE(above.value, 1.0101 * measured)
          << mesh.faces.size() << ' ' << degree << ' ' << above.cells;
      EXPECT_GT(bound(0.99 * measured, 20'000).value, 0.999 * measured);
    }
  }
}

TEST(radial_bound, says_nothing_of_the_inverse_of_the_radius) {
  Expansion gauge = ball(1);
  gauge.function = RadialFunction::kGauge;
  const Mesh mesh = octahedron();
  EXPECT_FALSE(truncation_errors(view_of(mesh), gauge).max_bound.has_value());
}

TEST(radial_bound, has_the_same_bits_for_any_number_of_threads) {
  const Mesh mesh = test::rotated(bumpy_sphere(5, 0.3));  // more faces than one task
  const Expansion expansion = expansion_of(mesh, 20);
  const BoundOptions options{.seen = 0.01, .enough = 0.0101, .most_cells = 30'000};
  const RadialBound one = bound_of(mesh, expansion, options);
  const RadialBound three = bound_of(mesh, expansion, options, 3);
  EXPECT_EQ(one.value, three.value);
  EXPECT_EQ(one.cells, three.cells);
  EXPECT_GT(one.cells, 0u);
}

}  // namespace
}  // namespace rholm
