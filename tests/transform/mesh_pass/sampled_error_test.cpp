// Errors of rules and windows, estimated from a sample and compared with direct sums.
#include "transform/mesh_pass/sampled_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "rholm/primitives.h"
#include "rholm/rotate.h"
#include "rholm/topology.h"
#include "rholm/transform.h"
#include "support/random_bodies.h"
#include "support/sizes.h"
#include "transform/mesh_pass/pass.h"
#include "transform/mesh_pass/plan/error_budget.h"
#include "transform/mesh_pass/plan/plan.h"
#include "transform/mesh_pass/run_pass.h"

namespace rholm {
namespace {

using test::random_bodies::of_rings;
using test::random_bodies::ring;

Coefficients exact_of(const Mesh& mesh, int degree, double precision) {
  const StarChart chart{.mesh = mesh, .edges = pair_edges(mesh), .report = {}};
  return expand(chart, {.degree = degree, .engine = Engine::kDirect, .precision = precision})
      .expansion.coefficients;
}

double distance(Coefficients a, const Coefficients& b) {
  for (std::size_t i = 0; i < a.values().size(); ++i) a.values()[i] -= b.values()[i];
  return norm_of_degrees(a, 1, a.degree());
}

// Returns a cylinder with `teeth` teeth, whose radius changes between 1 and 1 - `depth`.
Mesh gear(int n, int layers, int teeth, double depth) {
  std::vector<std::vector<Vec3>> rings;
  for (int k = 0; k <= layers; ++k) {
    rings.push_back(ring(n, 1, 0.8 - 1.6 * k / layers));
    for (int i = 0; i < n; ++i) {
      const double r = i * 2 * teeth / n % 2 == 0 ? 1 : 1 - depth;
      rings.back()[i].x *= r, rings.back()[i].y *= r;
    }
  }
  return of_rings(rings, 1, -1);
}

// Turns a mesh so that it is aligned with no axis.
Mesh oblique(Mesh mesh) {
  const RotationMatrix rows = matrix_of({.w = 0.5, .x = 0.7, .y = 0.1, .z = 0.5});
  for (Vec3& v : mesh.vertices) v = {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
  return mesh;
}

Mesh elongated(int n, int layers, double length) {
  std::vector<std::vector<Vec3>> rings;
  for (int k = 1; k < layers; ++k) {
    const double theta = std::numbers::pi * k / layers;
    rings.push_back(ring(n, std::sin(theta), length * std::cos(theta)));
  }
  return oblique(of_rings(rings, length, -length));
}

struct Sampled {
  double truth = 0, beside = 0;  // error of the pass, and the model's error without rules
  std::vector<SampledError> said;
};

Sampled sample(const Mesh& mesh, const Coefficients& exact, double precision,
               const std::vector<double>& shares, double window_share = 0.01) {
  const int degree = exact.degree();
  const MeshView view = view_of(mesh);
  MeshPassOptions options{.degree = degree, .precision = precision, .window_share = window_share};
  const MeshPlan plan =
      plan_mesh(view, sample_mesh(view, {}, degree), {}, degree, precision, PlanLimits{});
  MeshPassResult result;
  EXPECT_EQ(run_pass(view, options, plan, {}, result), Outcome::kDone);
  Sampled sampled{.truth = plan.block.scale * distance(result.coefficients, exact),
                  .beside = plan.block.scale * result.error_beside,
                  .said = {}};
  for (const double share : shares) {
    sampled.said.push_back(
        sample_error(view, options, plan, result.transform, result.block_errors, {}, share));
  }
  return sampled;
}

// Lumps with gradients, with Hessians, and separate nodes, also for triangles seen edge-on.
TEST(sampled_error, of_all_triangles_are_what_the_pass_leaves) {
  struct Case {
    Mesh mesh;
    int degree;
    double precision;
  };
  const Case cases[] = {{elongated(40, 30, 3), 6, 1e-3},
                        {elongated(40, 30, 3), 24, 1e-6},
                        {elongated(200, 8, 20), 12, 1e-5},
                        {gear(96, 20, 12, 0.2), 12, 1e-4},
                        {gear(60, 3, 10, 0.4), 32, 1e-6}};
  for (const auto& [mesh, degree, precision] : cases) {
    SCOPED_TRACE(fmt::format("{} {}", mesh.faces.size(), degree));
    const Coefficients exact = exact_of(mesh, degree, 1e-4 * precision);
    const Sampled sampled = sample(mesh, exact, precision, {1.0});
    const SampledError& rules = sampled.said[0];
    EXPECT_NEAR(rules.rules, sampled.truth, 0.5 * sampled.beside + 0.05 * sampled.truth);
    EXPECT_LT(rules.windows, 0.3 * sampled.truth);
    EXPECT_EQ(rules.share, 1);
    // Windows leave as much error as rules, or most of the error. Undivided sums have their own
    // windows.
    for (const double windows : {1.0, 30.0}) {
      SCOPED_TRACE(windows);
      const Sampled both = sample(mesh, exact, precision, {1.0}, windows);
      const SampledError& said = both.said[0];
      EXPECT_NEAR(said.rules, rules.rules, 1e-6 * rules.rules);
      EXPECT_NEAR(std::hypot(said.rules, said.windows), both.truth, 0.2 * both.truth);
    }
  }
}

// Nearly all vertices lie in two directions, within a part of the grid's step. Their window errors
// add up, to 12 times the value for random signs. Before this was estimated, the error was 1.45
// times the requested precision, and .34 was reported.
TEST(sampled_error, of_windows_where_vertices_crowd) {
  Mesh mesh = box({2, 2, 2}, 140);
  for (Vec3& v : mesh.vertices) {
    v = normalized(v);
    v = {0.01 * v.x, 0.01 * v.y, v.z};
  }
  mesh = oblique(std::move(mesh));
  const MeshView view = view_of(mesh);
  constexpr int kDegree = 16;
  constexpr double kWish = 1e-8;
  const MeshPassOptions options{.degree = kDegree, .precision = kWish};
  const MeshPlan plan =
      plan_mesh(view, sample_mesh(view, {}, kDegree), {}, kDegree, kWish, PlanLimits{});
  const auto pass = [&](double window_share) {
    MeshPassOptions wanted = options;
    wanted.window_share = window_share;
    MeshPassResult result;
    EXPECT_EQ(run_pass(view, wanted, plan, {}, result), Outcome::kDone);
    return result;
  };
  const MeshPassResult result = pass(10);
  const double windows = plan.block.scale * distance(result.coefficients, pass(1e-4).coefficients);
  const auto windows_of = [&](double share) {
    return sample_error(view, options, plan, result.transform, result.block_errors, {}, share)
        .windows;
  };
  EXPECT_NEAR(windows_of(1), windows, 0.01 * windows);
  // A sample may miss it, in at most one of these five cases.
  int seen = 0;
  for (const double share : {0.07, 0.074, 0.078, 0.082, 0.086}) {
    const double said = windows_of(share);
    if (said == 0) continue;
    SCOPED_TRACE(share);
    ++seen;
    EXPECT_GT(said, 0.5 * windows);
    EXPECT_LT(said, 2 * windows);
  }
  EXPECT_GE(seen, 4);
  const MeshPassResult found = mesh_pass(view, options, {});
  const MeshPassResult fine = mesh_pass(view, {.degree = kDegree, .precision = 1e-11}, {});
  EXPECT_TRUE(found.report.reached);
  EXPECT_LT(distance(found.coefficients, fine.coefficients),
            kWish * norm_of_degrees(fine.coefficients, 1, kDegree));
}

// Errors that add up (needles and walls around an axis), and errors that do not.
TEST_OF_TWO_SIZES(sampled_error, of_some_triangles_are_right_within_their_doubt) {
  std::vector<std::pair<Mesh, int>> cases = {{gear(240, 60, 24, 0.2), 8},
                                             {elongated(120, 120, 1.5), 8}};
  if (nightly) {
    cases = {{elongated(300, 100, 30), 12},
             {gear(240, 100, 24, 0.2), 12},
             {elongated(200, 200, 1.5), 16}};
  }
  for (const auto& [mesh, degree] : cases) {
    SCOPED_TRACE(std::to_string(mesh.faces.size()) + " " + std::to_string(degree));
    const Sampled sampled =
        sample(mesh, exact_of(mesh, degree, 1e-9), 1e-5, {0.26, 0.28, 0.3, 0.33, 0.37, 0.42});
    double mean2 = 0;
    for (const SampledError& said : sampled.said) {
      EXPECT_LT(said.share, 1);
      EXPECT_GT(said.rules + said.uncertainty, sampled.truth - 0.5 * sampled.beside);
      mean2 += said.rules * said.rules / static_cast<double>(sampled.said.size());
    }
    EXPECT_GT(std::sqrt(mean2), 0.5 * sampled.truth - 0.5 * sampled.beside);
    // Cancellation between neighbours, as on the last body, is not detected.
    EXPECT_LT(std::sqrt(mean2), 3 * sampled.truth + sampled.beside);
  }
}

// Above kMostVerified only the model's estimate was used: errors reached 4.5 times the request.
TEST_OF_TWO_SIZES(sampled_error, of_large_meshes_keep_the_wish) {
  std::vector<Mesh> meshes = {oblique(gear(480, 105, 24, 0.2))};
  if (nightly) meshes.push_back(elongated(320, 160, 100));
  for (const Mesh& mesh : meshes) {
    SCOPED_TRACE(mesh.faces.size());
    ASSERT_GT(mesh.faces.size(), kMostVerified);
    const Coefficients exact = exact_of(mesh, 8, 1e-8);  // a hundredth of the smaller precision
    for (const double wish : {1e-4, 1e-6}) {
      const MeshPassOptions options{.degree = 8, .precision = wish};
      const MeshPassResult found = mesh_pass(view_of(mesh), options, {});
      const double error = distance(found.coefficients, exact) / norm_of_degrees(exact, 1, 8);
      EXPECT_TRUE(found.report.reached);
      EXPECT_GT(found.report.measured_share, 0);
      EXPECT_LT(found.report.measured_share, 0.1);
      EXPECT_LE(error, wish);
      EXPECT_GT(found.report.error + found.report.error_uncertainty, 0.5 * error);
      const MeshPassResult again = mesh_pass(view_of(mesh), options, {.threads = 3});
      EXPECT_EQ(found.report.error, again.report.error);
      EXPECT_EQ(found.report.error_uncertainty, again.report.error_uncertainty);
    }
  }
}

// All nodes have one sign and many have one phase. Windows in single precision, or windows chosen
// for random signs, would exceed the requested precision.
TEST_OF_TWO_SIZES(sampled_error, windows_of_faces_seen_edge_on_keep_the_wish) {
  const Mesh mesh = gear(480, 60, 48, 0.2);
  for (const int degree : nightly ? std::vector{8, 32} : std::vector{8}) {
    const Sampled sampled = sample(mesh, exact_of(mesh, degree, 1e-9), 1e-5, {1.0});
    EXPECT_NEAR(sampled.said[0].rules, sampled.truth, 0.5 * sampled.beside + 0.2 * sampled.truth);
  }
}

}  // namespace
}  // namespace rholm
