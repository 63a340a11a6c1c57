#include "rholm/transfer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "base/random.h"
#include "edit/region/local_mesh.h"
#include "edit/sheet.h"
#include "edit/texture/refine.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "support/sizes.h"
#include "support/test_meshes.h"

namespace rholm {
namespace {

using std::numbers::pi;

using Regions = std::vector<Region>;

// Returns the height of bumps without symmetry: waves of length 0.11 to 0.16, height at most 1.
double pattern(double p, double q) {
  double sum = 0;
  for (std::uint64_t k = 0; k < 6; ++k) {
    const double angle = pi * random_uniform(5, k), wave = 0.11 + 0.05 * random_uniform(6, k);
    sum += std::cos(2 * pi * (p * std::cos(angle) + q * std::sin(angle)) / wave +
                    6 * static_cast<double>(k));
  }
  return sum / 6;
}

// Returns a sphere with the pattern around its north pole, as a function of angles.
Mesh patterned_sphere(int subdivisions, double radius, double height) {
  Mesh mesh = icosphere(subdivisions);
  for (Vec3& v : mesh.vertices) {
    const double theta = std::acos(std::min(1.0, std::max(-1.0, v.z)));
    const double phi = std::atan2(v.y, v.x);
    v *= radius + height * pattern(theta * std::cos(phi), theta * std::sin(phi));
  }
  return mesh;
}

struct Result {
  Mesh mesh;
  TransferReport report;
};
Result moved_by(const Mesh& source, const Regions& from, const Mesh& target, const Regions& to,
                const TransferOptions& options, const TransferUpdate& wanted) {
  TransferAnalysis analysis = analyze_transfer(source, from, target, to, options);
  apply(analysis.patch, update(analysis, wanted), analysis.mesh);
  return {std::move(analysis.mesh), analysis.report};
}

struct Error2 {
  double error = 0, wanted = 0;
  double part() const { return std::sqrt(error / wanted); }
};

TEST(Transfer, pattern_moves_between_spheres_of_different_size) {
  const Mesh source = patterned_sphere(7, 1, 0.008);
  Mesh target = icosphere(7);
  for (Vec3& v : target.vertices) v *= 3;
  const Result moved =
      moved_by(source, Regions{BallRegion{{0, 0, 1}, 0.5}}, target,
               Regions{BallRegion{{0, 0, 3}, 1.5}}, {.from_degree = 8}, {.angle = 0.0});
  EXPECT_NEAR(moved.report.scale, 3, 0.01);
  Error2 error;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < target.vertices.size(); ++i) {
    const Vec3 u = target.vertices[i] / 3, x = moved.mesh.vertices[i];
    if (norm(u - Vec3{0, 0, 1}) > 0.76) {  // radius of region and transition, 0.5 + 0.25
      outside += 1;
      EXPECT_EQ(test::bits_of(x), test::bits_of(target.vertices[i]));
    }
    if (norm(u - Vec3{0, 0, 1}) > 0.48) continue;
    const double theta = std::acos(u.z), phi = std::atan2(u.y, u.x);
    const double wanted = 0.024 * pattern(theta * std::cos(phi), theta * std::sin(phi));
    error.error += std::pow(norm(x) - 3 - wanted, 2);
    error.wanted += wanted * wanted;
  }
  EXPECT_LT(error.part(), 0.05);
  EXPECT_GT(outside, 100000u);
}

// Charts have their centre 3.7 radii below, where neither patch is curved (method 7.2).
TEST(Transfer, pattern_moves_from_a_plane_to_a_saddle) {
  const double h = 0.01;
  const Mesh source = test::sheet(180, h, [](double x, double y) { return 0.004 * pattern(x, y); });
  const auto saddle = [](double x, double y) { return (x * x - y * y) / 4; };
  const Mesh target = test::sheet(180, h, saddle);
  const Result moved =
      moved_by(source, Regions{BallRegion{{0, 0, 0}, 0.5}}, target,
               Regions{BallRegion{{0, 0, 0}, 0.5}}, {.from_degree = 8}, {.angle = 0.0});
  const double source_depth = 3.7 * moved.report.source_radius;
  const double target_depth = 3.7 * moved.report.target_radius;
  Error2 error;
  for (std::size_t i = 0; i < target.vertices.size(); ++i) {
    const Vec3& v = target.vertices[i];
    const double rho = std::hypot(v.x, v.y);
    if (norm(v) > 0.48 || rho == 0) continue;
    const double length = std::atan2(rho, target_depth + v.z) * target_depth;
    const double there = source_depth * std::tan(length / moved.report.scale / source_depth);
    const double wanted =
        moved.report.scale * 0.004 * pattern(there * v.x / rho, there * v.y / rho);
    const Vec3 normal = normalized({-v.x / 2, v.y / 2, 1});
    const Vec3 move = moved.mesh.vertices[i] - v;
    error.error += std::pow(dot(move, normal) - wanted, 2);
    error.wanted += wanted * wanted;
  }
  EXPECT_LT(error.part(), 0.05);
}

// Rotates v by `angle` about a unit axis.
Vec3 turn(const Vec3& v, const Vec3& axis, double angle) {
  const double c = std::cos(angle);
  return c * v + std::sin(angle) * cross(axis, v) + (1 - c) * dot(axis, v) * axis;
}

// The target is turned about its own axis by the angle to be found. Then the axis is turned to a
// random direction by the shortest rotation.
TEST_OF_TWO_SIZES(Transfer, angle_is_found_within_a_degree) {
  const Mesh source =
      test::sheet(90, 0.02, [](double x, double y) { return 0.004 * pattern(x, y); });
  const Mesh bowed = test::sheet(
      90, 0.02, [&](double x, double y) { return 0.004 * pattern(x, y) - (x * x + y * y) / 6; });
  const Regions disc = {BallRegion{{0, 0, 0}, 0.5}};
  for (std::uint64_t k = 0; k < (nightly ? 50 : 12); ++k) {
    const double angle = 2 * pi * random_uniform(9, k) - pi;
    const double heading = 2 * pi * random_uniform(10, k), tilt = 3 * random_uniform(11, k);
    const Vec3 across = {std::cos(heading), std::sin(heading), 0};
    Mesh target = bowed;
    for (Vec3& v : target.vertices) v = turn(turn(v, {0, 0, 1}, angle), across, tilt);
    const TransferReport found =
        analyze_transfer(source, disc, target, disc, {.from_degree = 8}).report;
    EXPECT_LT(std::abs(std::remainder(found.angle - angle, 2 * pi)), pi / 180) << angle;
    EXPECT_GT(found.correlation, 0.8);
  }
}

TEST(Transfer, an_angle_that_is_given_need_not_be_found) {
  const Mesh mesh = test::sheet(60, 0.02, [](double x, double y) { return 0.004 * pattern(x, y); });
  const Regions disc = {BallRegion{{0, 0, 0}, 0.5}};
  const TransferAnalysis found = analyze_transfer(mesh, disc, mesh, disc);
  const TransferAnalysis given = analyze_transfer(mesh, disc, mesh, disc, {.find_angle = false});
  EXPECT_EQ(given.report.angle, 0);
  EXPECT_EQ(given.report.correlation, 0);
  for (const double angle : {0.0, 1.0}) {
    EXPECT_EQ(update(given, {.angle = angle}), update(found, {.angle = angle}));
    EXPECT_EQ(update(given, {.angle = angle, .repeat = true}),
              update(found, {.angle = angle, .repeat = true}));
  }
  EXPECT_EQ(update(given), update(found, {.angle = 0}));
}

TEST(Transfer, a_source_serves_several_targets_alike) {
  const Mesh source = patterned_sphere(5, 1, 0.02);
  const Mesh smooth = icosphere(5), own = patterned_sphere(5, 2, 0.04);
  const Regions from{BallRegion{{0, 0, 1}, 0.6}};
  const TransferOptions options{.from_degree = 6, .scale = 0.8};
  const TransferUpdate wanted{.repeat = true};
  const TransferSource texture = analyze_source(source, from, options.from_degree);
  for (const Mesh* target : {&smooth, &own, &smooth}) {
    for (const Vec3 at : {Vec3{0, 0, 1}, Vec3{0, 1, 0}}) {
      const Regions to{BallRegion{norm(target->vertices[0]) * at, 0.5}};
      const Result at_once = moved_by(source, from, *target, to, options, wanted);
      TransferAnalysis analysis = analyze_transfer(texture, *target, to, options);
      apply(analysis.patch, update(analysis, wanted), analysis.mesh);
      ASSERT_EQ(analysis.mesh.vertices.size(), at_once.mesh.vertices.size());
      std::size_t moved = 0;
      for (std::size_t i = 0; i < analysis.mesh.vertices.size(); ++i) {
        EXPECT_EQ(test::bits_of(analysis.mesh.vertices[i]),
                  test::bits_of(at_once.mesh.vertices[i]));
        moved += test::bits_of(analysis.mesh.vertices[i]) != test::bits_of(target->vertices[i]);
      }
      EXPECT_GT(moved, 100u);
      EXPECT_EQ(analysis.report.source_rms, at_once.report.source_rms);
      EXPECT_EQ(analysis.report.angle, at_once.report.angle);
    }
  }
}

TEST(Transfer, meshes_that_are_inside_out_have_their_heights_outwards) {
  const Mesh source = patterned_sphere(5, 1, 0.02), target = icosphere(5);
  const Regions at = {BallRegion{{0, 0, 1}, 0.5}};
  const auto flipped = [](Mesh mesh) {
    flip(mesh);
    return mesh;
  };
  for (const bool refined : {false, true}) {
    const TransferOptions options = {.from_degree = 4, .refine = refined};
    const Mesh expected = transfer(source, at, target, at, options);
    EXPECT_NE(expected.vertices, target.vertices);
    for (const bool from : {false, true}) {
      for (const bool to : {false, true}) {
        const Mesh found = transfer(from ? flipped(source) : source, at,
                                    to ? flipped(target) : target, at, options);
        EXPECT_EQ(found.vertices, expected.vertices) << from << to;
        EXPECT_EQ(found.faces, (to ? flipped(expected) : expected).faces) << from << to;
      }
    }
  }
}

TEST(Transfer, a_source_of_another_detail_is_refused) {
  const Mesh ball = icosphere(4);
  const Regions disc{BallRegion{{0, 0, 1}, 0.5}};
  const TransferSource texture = analyze_source(ball, disc, 4);
  EXPECT_NO_THROW(analyze_transfer(texture, ball, disc, {.from_degree = 4}));
  EXPECT_THROW(analyze_transfer(texture, ball, disc, {.from_degree = 5}), Error);
  EXPECT_THROW(analyze_transfer(TransferSource{}, ball, disc, {.from_degree = 4}), Error);
  EXPECT_THROW(analyze_transfer(texture, ball, {}, {.from_degree = 4}), Error);
  EXPECT_THROW(analyze_source(ball, {}, 4), Error);
  for (const int degree : {1, kMaxTransferDegree + 1}) {
    EXPECT_THROW(analyze_source(ball, disc, degree), Error);
  }
}

TEST(Transfer, what_replaces_its_own_detail_changes_little) {
  const Mesh mesh =
      test::sheet(180, 0.01, [](double x, double y) { return 0.004 * pattern(x, y); });
  const Regions disc = {BallRegion{{0, 0, 0}, 0.5}};
  const Result moved = moved_by(mesh, disc, mesh, disc, {.from_degree = 8}, {.remove_own = true});
  Error2 error;
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (norm(mesh.vertices[i]) > 0.48) continue;
    error.error += std::pow(moved.mesh.vertices[i].z - mesh.vertices[i].z, 2);
    error.wanted += std::pow(mesh.vertices[i].z, 2);
  }
  EXPECT_LT(error.part(), 0.05);
  EXPECT_NEAR(moved.report.angle, 0, pi / 180);
}

TEST(Transfer, repeated_texture_covers_a_larger_region_as_strongly) {
  const Mesh source =
      test::sheet(90, 0.02, [](double x, double y) { return 0.004 * pattern(x, y); });
  const Mesh target = test::sheet(160, 0.01);
  const Regions from = {BallRegion{{0, 0, 0}, 0.5}}, to = {BallRegion{{0, 0, 0}, 0.5}};
  const TransferAnalysis analysis =
      analyze_transfer(source, from, target, to, {.from_degree = 8, .scale = 0.4});
  const auto rms_beyond = [&](bool repeat) {
    double sum = 0, count = 0;
    for (const Vec3& v : update(analysis, {.angle = 0.3, .repeat = repeat})) {
      const double rho = std::hypot(v.x, v.y);
      if (rho < 0.4 || rho > 0.5) continue;
      sum += v.z * v.z;
      ++count;
    }
    return std::sqrt(sum / count);
  };
  const double rms = analysis.report.source_rms;
  EXPECT_NEAR(rms_beyond(true), 0.4 * rms, 0.06 * rms);
  EXPECT_EQ(rms_beyond(false), 0);
}

TEST(Transfer, raw_coefficients_step_at_the_rim_where_displacements_fade) {
  const Mesh source =
      test::sheet(90, 0.02, [](double x, double y) { return 0.004 * pattern(x, y); });
  const Mesh target = test::sheet(90, 0.02);
  const Regions disc = {BallRegion{{0, 0, 0}, 0.5}};
  const auto step = [&](TransferMode mode) {
    const Mesh moved =
        transfer(source, disc, target, disc, {.from_degree = 8}, {.angle = 0.0, .mode = mode});
    double largest = 0;
    for (const Triangle& t : moved.faces) {
      const Vec3 &a = target.vertices[t[0]], &b = target.vertices[t[1]];
      if ((norm(a) < 0.5) == (norm(b) < 0.5)) continue;
      largest = std::max(largest, std::abs(moved.vertices[t[0]].z - moved.vertices[t[1]].z));
    }
    return largest;
  };
  EXPECT_GT(step(TransferMode::kCoefficients), 1.2 * step(TransferMode::kDisplacement));
}

TEST(Transfer, refinement_closes_and_leaves_the_rest) {
  const Mesh source =
      test::sheet(90, 0.02, [](double x, double y) { return 0.004 * pattern(x, y); });
  Mesh target = icosphere(4);
  target.attributes = {
      {"scar", ScalarType::kUint8, std::vector<double>(target.vertices.size(), 0)}};
  for (std::size_t i = 0; i < target.vertices.size(); ++i) {
    target.attributes[0].values[i] = target.vertices[i].z > 0.85 ? 1 : 0;
  }
  const auto top = static_cast<std::uint32_t>(
      std::max_element(target.vertices.begin(), target.vertices.end(),
                       [](const Vec3& a, const Vec3& b) { return a.z < b.z; }) -
      target.vertices.begin());
  for (const Region& region : {Region{BallRegion{{0, 0, 1}, 0.5}}, Region{PropertyRegion{"scar"}},
                               Region{DiscRegion{top, 0.5}}}) {
    const Result moved =
        moved_by(source, Regions{BallRegion{{0, 0, 0}, 0.5}}, target, Regions{region},
                 {.from_degree = 8, .refine = true}, {.angle = 0.0});
    const Inspection found = inspect(moved.mesh);
    EXPECT_TRUE(found.closed && found.manifold && found.oriented);
    EXPECT_GT(moved.report.new_vertices, target.vertices.size());
    EXPECT_EQ(moved.mesh.attributes.size(), 1u);
    EXPECT_NO_THROW(validate(moved.mesh));
    for (std::size_t i = 0; i < target.vertices.size(); ++i) {
      EXPECT_TRUE(target.vertices[i].z > 0 || moved.mesh.vertices[i] == target.vertices[i]);
    }
  }
}

TEST(Refine, edges_get_short_and_a_sphere_stays_round) {
  Mesh mesh = icosphere(3);
  std::vector<double> weights(mesh.vertices.size(), 1);
  refine(mesh, weights, 0.05);
  EXPECT_TRUE(inspect(mesh).closed);
  for (const Triangle& t : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_LE(norm(mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]), 0.05);
    }
  }
  // With h = 0.145, flat middles of edges would lie h^2 / 8 = 2.6e-3 inside.
  for (const Vec3& v : mesh.vertices) EXPECT_NEAR(norm(v), 1, 3e-4);
}

TEST(Refine, what_would_be_too_large_is_refused_before_the_work) {
  for (const double length : {0., 1e-300, 1e-6}) {
    Mesh mesh = icosphere(3);
    std::vector<double> weights(mesh.vertices.size(), 0);
    weights[5] = 1;
    EXPECT_THROW(refine(mesh, weights, length), Error);
    EXPECT_EQ(mesh.vertices.size(), icosphere(3).vertices.size());
  }
}

TEST(LocalMesh, edges_do_not_depend_on_the_order_of_corners) {
  const std::vector<Vec3> points = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  for (const Triangle& t : {Triangle{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}) {
    EXPECT_EQ(median_edge(points, std::vector{t}, std::vector<double>{1, 0, 0}), 3);
    EXPECT_EQ(median_edge(points, std::vector{t}, std::vector<double>{1, 1, 1}), 4);
    EXPECT_EQ(median_edge(points, std::vector{t}, std::vector<double>{0, 0, 0}), 0);
  }
}

TEST(LocalMesh, vertices_at_the_same_place_are_one_point_whatever_the_sign_of_zero) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, -0.0, 0}, {1, 1, 0}, {-0.0, 1, -0.0}};
  mesh.faces = {{0, 1, 2}, {3, 4, 5}};
  const LocalMesh local = cut_out(mesh, bounds(mesh.vertices));
  EXPECT_EQ(local.points, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  EXPECT_EQ(local.faces, (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}}));
}

TEST(Transfer, what_cannot_be_done_is_refused) {
  const Mesh mesh = test::sheet(40, 0.05);
  const Regions disc = {BallRegion{{0, 0, 0}, 0.5}};
  for (const TransferOptions& options :
       {TransferOptions{.from_degree = 1}, TransferOptions{.from_degree = 1000},
        TransferOptions{.from_degree = 60},  // finer than the mesh allows
        TransferOptions{.scale = 0}, TransferOptions{.scale = std::nan("")},
        TransferOptions{.transition = -1}}) {
    EXPECT_THROW(transfer(mesh, disc, mesh, disc, options), Error);
  }
  for (const TransferUpdate& wanted :
       {TransferUpdate{.height = std::nan("")}, TransferUpdate{.angle = std::nan("")}}) {
    EXPECT_THROW(transfer(mesh, disc, mesh, disc, {}, wanted), Error);
  }
  EXPECT_THROW(
      transfer(mesh, disc, mesh, disc, {.from_degree = 24}, {.mode = TransferMode::kCoefficients}),
      Error);
  EXPECT_THROW(transfer({}, disc, mesh, disc), Error);
  EXPECT_THROW(transfer(mesh, disc, {}, disc), Error);
  EXPECT_THROW(transfer(mesh, {}, mesh, disc), Error);
  const Mesh ball = icosphere(4);  // no view shows all of it
  EXPECT_THROW(transfer(ball, Regions{BallRegion{{0, 0, 0}, 2}}, mesh, disc), Error);
}

}  // namespace
}  // namespace rholm
