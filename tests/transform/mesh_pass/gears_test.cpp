// Bodies of many similar parts that match the period of the grid, compared with direct sums. There
// is one pass only, without a second reading.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "rholm/transform.h"
#include "support/oracle.h"
#include "support/random_bodies.h"
#include "support/sizes.h"
#include "transform/mesh_pass/pass.h"

namespace rholm {
namespace {

using test::relative_error;

// A single direct sum of the last, highest degree gives the coefficients of all degrees.
void check_error_of_pass(const Mesh& mesh, const std::vector<int>& degrees, double precision) {
  const StarChart chart{.mesh = mesh, .edges = pair_edges(mesh), .report = {}};
  const Coefficients exact =
      expand(chart,
             {.degree = degrees.back(), .engine = Engine::kDirect, .precision = 1e-2 * precision})
          .expansion.coefficients;
  for (const int degree : degrees) {
    const MeshPassOptions options{.degree = degree, .precision = precision};
    const Coefficients found = mesh_pass(view_of(mesh), options, {}).coefficients;
    EXPECT_LT(relative_error(found, exact.resized(degree)), 0.5 * precision) << "L " << degree;
  }
}

// Walls of 1e-4 rad are seen edge-on, one per tooth. On a grid of n longitudes, errors of order L
// add up where n - L is a multiple of the number of teeth.
TEST_OF_TWO_SIZES(mesh_pass, keeps_the_precision_of_gears_with_walls_seen_edge_on) {
  struct Case {
    int teeth, layers;
    std::vector<int> degrees;
  };
  std::vector<Case> cases = {{8, 1, {32}}};
  if (nightly) cases = {{8, 1, {32, 64, 128}}, {48, 3, {64}}};
  for (const auto& [teeth, layers, degrees] : cases) {
    SCOPED_TRACE(teeth);
    const double tooth = 2 * std::numbers::pi / teeth;
    const Mesh gear = test::random_bodies::gear(teeth, layers, 0.5, 0.2, 1e-4 / tooth);
    check_error_of_pass(gear, degrees, 1e-6);
  }
}

TEST_OF_TWO_SIZES(mesh_pass, keeps_the_precision_of_a_thin_box_off_centre) {
  Mesh thin = box({2, 1.5, 0.1}, 4);
  for (Vec3& x : thin.vertices) x += Vec3{0.3, 0.2, 0.02};
  check_error_of_pass(thin, nightly ? std::vector{32, 64, 128} : std::vector{32}, 1e-6);
}

// Turned by a generic rotation, the body has the same error; neither error is zero to rounding.
TEST(mesh_pass, leaves_orders_zero_that_a_body_of_revolution_does_not_have) {
  std::vector<std::vector<Vec3>> rings;
  for (int k = 0; k <= 20; ++k) {
    const double z = 1 - k / 10.0;
    rings.push_back(test::random_bodies::ring(128, 0.6 + 0.3 * std::cos(3 * z), 1.5 * z));
  }
  const Mesh vase = test::random_bodies::of_rings(rings, 1.5, -1.5);
  for (const double precision : {1e-3, 1e-6}) {
    const MeshPassOptions options{.degree = 64, .precision = precision};
    const Coefficients found = mesh_pass(view_of(vase), options, {}).coefficients;
    Coefficients round = found;
    for (int l = 1; l <= 64; ++l) {
      for (int m = 1; m <= l; ++m) round.c(l, m) = round.s(l, m) = 0;
    }
    EXPECT_LT(relative_error(found, round), 1e-2 * precision) << relative_error(found, round);
  }
}

// A body that is nearly a ball, with rows about y and too many faces for a second reading. All
// weights cancel, but their errors of windows do not.
TEST(mesh_pass, keeps_the_precision_of_a_planet_of_rows_about_another_axis) {
  Mesh planet = latitude_longitude_sphere(224, 448);
  for (Vec3& x : planet.vertices) {
    const Vec3 u = {x.y, x.z, x.x};
    x = (1 + 1e-4 * u.x * (1 + u.y * u.z)) * u;
  }
  const auto pass = [&](double precision) {
    const MeshPassOptions options{.degree = 64, .precision = precision};
    return mesh_pass(view_of(planet), options, {}).coefficients;
  };
  EXPECT_LT(relative_error(pass(1e-3), pass(1e-6)), 0.5e-3);
}

}  // namespace
}  // namespace rholm
