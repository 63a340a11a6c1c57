// The measured error of a pass compared with direct sums, on bodies whose errors add up.
#include "transform/mesh_pass/verify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "rholm/primitives.h"
#include "rholm/rotate.h"
#include "rholm/topology.h"
#include "rholm/transform.h"
#include "support/random_bodies.h"
#include "support/sizes.h"
#include "transform/mesh_pass/plan/error_budget.h"

namespace rholm {
namespace {

struct Judged {
  FastReport report;
  double true_error = 0;  // relative, like FastReport::error
};

// The centre is the origin.
Judged judge(const Mesh& mesh, int degree, double precision, Method oracle = Method::kEdge) {
  const MeshPassOptions options{.degree = degree, .precision = precision};
  MeshPassResult found = mesh_pass(view_of(mesh), options, {});
  verify_pass(view_of(mesh), options, {}, found);
  const StarChart chart{.mesh = mesh, .edges = pair_edges(mesh), .report = {}};
  const Coefficients exact = expand(chart, {.degree = degree,
                                            .method = oracle,
                                            .engine = Engine::kDirect,
                                            .precision = 1e-3 * precision})
                                 .expansion.coefficients;
  Coefficients error = found.coefficients;
  for (std::size_t i = 0; i < error.values().size(); ++i) error.values()[i] -= exact.values()[i];
  return {.report = found.report,
          .true_error = norm_of_degrees(error, 1, degree) / norm_of_degrees(exact, 1, degree)};
}

void expect_is_kept(const Judged& judged, double precision) {
  EXPECT_EQ(judged.report.measured_share, 1);
  EXPECT_TRUE(judged.report.reached);
  EXPECT_LE(judged.true_error, precision);
  EXPECT_GT(judged.report.error, 0.5 * judged.true_error);
  EXPECT_LT(judged.report.error, 3 * judged.true_error);
}

// Errors of the needles of its side add up to 1.5 to 6.5 times the requested precision. The model
// estimates at most a quarter of them.
TEST(verify_pass, of_a_rod_keeps_the_wish) {
  std::vector<std::vector<Vec3>> rings;
  for (const double z : {1.0, -1.0}) rings.push_back(test::random_bodies::ring(200, 0.02, z));
  const Mesh rod = test::random_bodies::of_rings(rings, 1, -1);
  const MeshPassOptions options{.degree = 16, .precision = 1e-8};
  const MeshPassResult first = mesh_pass(view_of(rod), options, {});
  const Judged judged = judge(rod, 16, 1e-8);
  expect_is_kept(judged, 1e-8);
  EXPECT_GT(judged.report.passes, first.report.passes);
}

TEST_OF_TWO_SIZES(verify_pass, of_a_cube_seen_from_before_a_face_keeps_the_wish) {
  Mesh cube = box({2, 2, 2});
  for (Vec3& v : cube.vertices) v.x -= 1 - 2.6e-6;
  expect_is_kept(judge(cube, nightly ? 64 : 24, 1e-8), 1e-8);
}

// The planes of the largest faces nearly contain the centre. Their weights are 1e8 times their sum,
// and have the same rounding in every reading. The oracle has no terms that cancel.
TEST_OF_TWO_SIZES(verify_pass, of_a_prism_seen_from_beside_a_corner_keeps_the_wish) {
  std::vector<std::vector<Vec3>> rings;
  for (int k = 0; k <= 5; ++k) {
    rings.push_back(test::random_bodies::ring(18, 0.0253, 1 - 2.0 * k / 5));
  }
  const Mesh prism = test::random_bodies::of_rings(rings, 1, -1);
  const Rotation rotation = rotation_of(EulerAngles{1, 2, 3});
  for (const double inwards : nightly ? std::vector{3e-8, 1e-7, 6e-7, 5e-6} : std::vector{1e-7}) {
    for (const double below : {9e-6, 1e-4}) {
      SCOPED_TRACE(testing::Message() << inwards << " " << below);
      const Vec3 corner = rings[0][0], center{corner.x - inwards, corner.y, corner.z - below};
      Mesh seen = prism;
      for (Vec3& v : seen.vertices) v = rotate(v - center, rotation);
      expect_is_kept(judge(seen, 13, 1e-9, Method::kArea), 1e-9);
    }
  }
}

// All faces at the tip are large and near, and none is seen at a grazing angle. Direct sums use the
// same weights, so that they are tested, too.
TEST_OF_TWO_SIZES(verify_pass, of_a_flat_cone_seen_from_below_its_tip_keeps_the_wish) {
  const Rotation rotation = rotation_of(EulerAngles{1, 2, 3});
  for (const int sides : nightly ? std::vector{3, 5, 60} : std::vector{5}) {
    for (const double below : {1e-4, 3e-6, 5e-8}) {
      SCOPED_TRACE(testing::Message() << sides << " " << below);
      Mesh seen =
          test::random_bodies::of_rings({test::random_bodies::ring(sides, 1, 0)}, 0.035, -0.07);
      for (Vec3& v : seen.vertices) v = rotate(v - Vec3{0, 0, 0.035 - below}, rotation);
      expect_is_kept(judge(seen, 5, 1e-9, Method::kArea), 1e-9);
      const StarChart chart{.mesh = seen, .edges = pair_edges(seen), .report = {}};
      const auto sum = [&](Method method) {
        return expand(
                   chart,
                   {.degree = 5, .method = method, .engine = Engine::kDirect, .precision = 1e-12})
            .expansion.coefficients;
      };
      const Coefficients exact = sum(Method::kArea);
      Coefficients error = sum(Method::kEdge);
      for (std::size_t i = 0; i < error.values().size(); ++i)
        error.values()[i] -= exact.values()[i];
      EXPECT_LE(norm_of_degrees(error, 1, 5), 2e-12 * norm_of_degrees(exact, 1, 5));
    }
  }
}

// The sides are long faces that meet next to the centre. Their weights are 1e5 times the radius,
// and the rounding of their sums adds up around the axis: the search found 1.1 times the wish, and
// a third of that reported.
void expect_of_a_tall_cone(int sides) {
  const double below = 4.915e-4, flat = 0.00241;
  Mesh seen =
      test::random_bodies::of_rings({test::random_bodies::ring(sides, 0.08753, 0)}, 1, -flat);
  for (Vec3& v : seen.vertices) v = v - Vec3{0, 0, 1 - below};
  expect_is_kept(judge(seen, 15, 1e-9, Method::kArea), 1e-9);
}
TEST(verify_pass, of_a_tall_cone_seen_from_below_its_tip_keeps_the_wish) {
  expect_of_a_tall_cone(24);
}
TEST(verify_pass, of_a_tall_cone_of_many_sides_keeps_the_wish_nightly) {
  expect_of_a_tall_cone(481);
}

// The measured error is tested, too: for 98 of 100 bodies it is within these factors.
TEST(verify_pass, keeps_the_wish_on_random_bodies) {
  std::vector<double> ratios;
  double worst = 0;
  for (std::uint64_t seed = 2; seed < 2 + RHOLM_RANDOM_BODIES; ++seed) {
    const test::RandomBody body = test::random_body(test::random_genes(seed));
    SCOPED_TRACE(body.family + " " + std::to_string(seed));
    Mesh mesh = body.mesh;
    for (Vec3& v : mesh.vertices) v -= body.center;
    const Judged judged = judge(mesh, body.degree, body.precision);
    EXPECT_EQ(judged.report.measured_share, 1);
    EXPECT_TRUE(judged.report.reached);
    EXPECT_LE(judged.true_error, body.precision);
    worst = std::max(worst, judged.true_error / body.precision);
    if (judged.true_error > 0) ratios.push_back(judged.report.error / judged.true_error);
  }
  std::sort(ratios.begin(), ratios.end());
  const auto percentile = [&](double share) {
    return ratios[static_cast<std::size_t>(share * static_cast<double>(ratios.size() - 1))];
  };
  std::printf("worst true / wish %.3f; reported / true 1 %% %.3f, median %.3f, 99 %% %.3f\n", worst,
              percentile(0.01), percentile(0.5), percentile(0.99));
  EXPECT_GT(percentile(0.01), 0.5);
  EXPECT_LT(percentile(0.99), 3);
}

// Degrees 1 and 2 of a tetrahedron are zero, and 1 to 3 of a cube. Both readings have only rounding
// there, so that their difference is as large as their values.
TEST_OF_TWO_SIZES(verify_pass, of_degrees_that_are_zero_by_symmetry_leaves_what_rounding_does) {
  Mesh tetrahedron;
  tetrahedron.vertices = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  tetrahedron.faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  const Mesh cube = box({2, 2, 2});
  for (int turn = 0; turn < (nightly ? 40 : 14); ++turn) {
    const Vec3 axis = test::random_direction(7, static_cast<std::uint64_t>(turn));
    const RotationMatrix rows = matrix_of(rotation_about(axis, 0.1 * turn));
    for (const auto& [body, last] : {std::pair(tetrahedron, 2), std::pair(cube, 3)}) {
      Mesh turned = body;
      for (Vec3& v : turned.vertices) {
        v = std::exp2(turn % 7) * Vec3{dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
      }
      for (int degree = 1; degree <= last; ++degree) {
        const MeshPassOptions options{.degree = degree, .precision = 1e-8};
        MeshPassResult found = mesh_pass(view_of(turned), options, {});
        verify_pass(view_of(turned), options, {}, found);
        EXPECT_TRUE(found.report.reached) << turn << ": degree " << degree << " of " << last;
        EXPECT_LT(norm_of_degrees(found.coefficients, 1, degree),
                  1e-14 * found.coefficients.c(0, 0));
      }
    }
  }
}

TEST(verify_pass, leaves_meshes_alone_that_are_too_large) {
  const Mesh sphere = bumpy_sphere(7);
  ASSERT_GT(sphere.faces.size(), kMostVerified);
  const MeshPassOptions options{.degree = 8, .precision = 1e-6};
  MeshPassResult found = mesh_pass(view_of(sphere), options, {});
  const double sampled = found.report.error;
  verify_pass(view_of(sphere), options, {}, found);
  EXPECT_LT(found.report.measured_share, 1);
  EXPECT_EQ(found.report.error, sampled);
}

}  // namespace
}  // namespace rholm
