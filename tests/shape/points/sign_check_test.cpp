// Given normals that contradict each other, and correct normals that resemble them.
#include "shape/points/sign_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/test_points.h"

namespace rholm {
namespace {

using test::joined;
using test::random_in;
using test::sphere_points;

// Returns a moved and scaled ball; with a negative size its normals point inwards.
PointCloud ball(std::size_t n, double size, const Vec3& middle, std::uint64_t seed) {
  PointCloud cloud = sphere_points(n, seed);
  for (Vec3& p : cloud.points) p = middle + std::abs(size) * p;
  if (size < 0) {
    for (Vec3& normal : cloud.normals) normal = -normal;
  }
  return cloud;
}

struct Checked {
  SignCheck signs;
  std::size_t left = 0;              // points that still contradict their neighbours
  double inward = 0;                 // as in MendedSigns
  std::vector<std::uint8_t> turned;  // in the order of the cloud
  std::size_t n_turned = 0;
};

// Points and normals in the order of a tree.
struct Scene {
  explicit Scene(const PointCloud& cloud) : tree(cloud.points) {
    for (const std::uint32_t i : tree.order()) {
      points.push_back(cloud.points[i]), normals.push_back(cloud.normals[i]);
    }
    gaps = find_gaps(tree, points, normals, {});
  }
  PointTree tree;
  std::vector<Vec3> points, normals;
  SamplingGaps gaps;
};

std::vector<SignSample> all_samples(const Scene& scene, const SignPieces& pieces) {
  std::vector<SignSample> samples;
  std::vector<Neighbor> near;
  for (std::uint32_t i = 0; i < scene.points.size(); ++i) {
    scene.tree.nearest_to(i, 9, near);
    const double disc = near.back().distance2;
    samples.push_back(
        {scene.points[i], scene.normals[i], std::numbers::pi * disc / 8, disc, pieces.piece[i]});
  }
  return samples;
}

Checked check(const PointCloud& cloud) {
  const Scene scene(cloud);
  const SignPieces pieces =
      find_sign_pieces(scene.tree, scene.points, scene.normals, scene.gaps, {}, {});
  const MendedSigns mended = mend_signs(all_of(pieces), all_samples(scene, pieces), true, {});
  Checked result{.signs = mended.check,
                 .left = contradicting_points(pieces, 0, mended.check, true).size(),
                 .inward = mended.inward,
                 .turned = std::vector<std::uint8_t>(cloud.points.size()),
                 .n_turned = mended.n_turned};
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    result.turned[scene.tree.order()[i]] = mended.turned[pieces.piece[i]];
  }
  return result;
}

// Turns the normals of the chosen points, and checks that exactly these are found.
template <class Chosen>
void expect_found(PointCloud cloud, const Chosen& chosen) {
  std::vector<std::uint8_t> wanted(cloud.points.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!chosen(i, cloud.points[i])) continue;
    wanted[i] = 1;
    cloud.normals[i] = -cloud.normals[i];
  }
  const Checked found = check(cloud);
  EXPECT_EQ(found.turned, wanted);
  EXPECT_EQ(found.left, 0U);
  EXPECT_EQ(found.inward, 0);
}

TEST(signs, that_are_turned_at_random_are_found) {
  for (const double share : {0.01, 0.1, 0.45}) {
    expect_found(sphere_points(3000),
                 [&](std::size_t i, const Vec3&) { return random_in(0, 1, 7, i) < share; });
  }
}

TEST(signs, of_patches_and_bands_are_found) {
  for (const double height : {0.98, 0.9, 0.5, 0.1}) {
    expect_found(sphere_points(3000), [&](std::size_t, const Vec3& p) { return p.z > height; });
  }
  expect_found(sphere_points(3000), [](std::size_t, const Vec3& p) { return std::abs(p.z) < 0.3; });
}

TEST(signs, of_a_whole_body_beside_another_are_found) {
  const PointCloud two = joined(ball(2000, 1, {}, 1), ball(800, -0.6, {2, 0, 0}, 2));
  const Checked found = check(two);
  EXPECT_EQ(found.n_turned, 800U);
  EXPECT_EQ(found.turned.back(), 1);
  EXPECT_EQ(found.inward, 0);
}

TEST(signs, of_a_hollow_that_faces_as_the_outer_wall_are_found) {
  const Checked found = check(joined(ball(2000, 1, {}, 1), ball(800, 0.6, {}, 2)));
  EXPECT_EQ(found.n_turned, 800U);
  EXPECT_EQ(found.turned.back(), 1);
}

TEST(signs, that_are_right_stay) {
  // A hollow ball, two touching balls, and two separate balls.
  EXPECT_EQ(check(joined(ball(2000, 1, {}, 1), ball(800, -0.6, {}, 2))).n_turned, 0U);
  EXPECT_EQ(check(joined(ball(3000, 1, {}, 1), ball(3000, 1, {2, 0, 0}, 2))).n_turned, 0U);
  EXPECT_EQ(check(joined(ball(2000, 1, {}, 1), ball(800, 0.6, {2, 0, 0}, 2))).n_turned, 0U);
}

// A plate of width 2 without its rim; the spacing is 0.05.
TEST(signs, of_two_near_walls_stay) {
  for (const double apart : {0.1, 0.03, 0.01, 0.003}) {
    for (const double facing : {1.0, -1.0}) {
      PointCloud cloud;
      for (std::size_t i = 0; i < 3200; ++i) {
        const double side = i % 2 == 0 ? 1 : -1;
        cloud.points.push_back({random_in(-1, 1, 1, i), random_in(-1, 1, 2, i), side * apart / 2});
        cloud.normals.push_back({0, 0, facing * side});
      }
      const Checked found = check(cloud);
      EXPECT_EQ(found.signs.n_turned, 0U) << apart << " " << facing;
      EXPECT_EQ(found.left, 0U) << apart << " " << facing;
    }
  }
}

// A height from one or two edges has no meaningful standard error.
TEST(signs, of_two_walls_are_told_by_three_edges_at_least) {
  for (const int edges : {1, 2, 3, 10}) {
    AllPieces all{.own = {100, 100}};
    PiecePair pair;
    pair.b = 1, pair.edges = edges;
    for (int e = 0; e < edges; ++e) pair.heights.add(0.1);
    all.pairs = {pair};
    const SignCheck found = check_signs(all, {}, {});
    EXPECT_EQ(found.walls.size(), edges < 3 ? 0U : 1U) << edges;
    EXPECT_EQ(found.counts(0, 1, false), edges < 3) << edges;
  }
}

// An open sheet has no inside, but its points agree on one orientation.
TEST(signs, of_an_open_sheet_follow_most_points) {
  PointCloud cloud;
  for (std::size_t i = 0; i < 2000; ++i) {
    const double x = random_in(-1, 1, 1, i), y = random_in(-1, 1, 2, i);
    cloud.points.push_back({x, y, 0});
    cloud.normals.push_back({0, 0, x > 0.2 ? 1.0 : -1.0});
  }
  const Checked found = check(cloud);
  for (std::size_t i = 0; i < 2000; ++i) EXPECT_EQ(found.turned[i] != 0, cloud.points[i].x > 0.2);
}

}  // namespace
}  // namespace rholm
