// Random bodies, sampled well and badly: every result is a closed 2-manifold, by exact counts of
// edges and vertex links. The test is long and has the label nightly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "rholm/error.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "rholm/reconstruct.h"
#include "rholm/topology.h"
#include "shape/queries/winding_tree.h"
#include "support/test_meshes.h"
#include "support/test_points.h"

namespace rholm {
namespace {

constexpr int kInputs = 200;

// A sequence of random numbers.
struct Dice {
  std::uint64_t seed;
  std::uint64_t next = 0;
  double in(double low, double high) { return test::random_in(low, high, seed, next++); }
  bool once_in(int n) { return in(0, 1) * n < 1; }
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(in(0, 1) * static_cast<double>(n));
  }
};

Mesh random_body(Dice& dice) {
  switch (dice.below(4)) {
    case 0:
      return bumpy_sphere(4, dice.in(0, 0.4), dice.below(1000));
    case 1:
      return torus(1, dice.in(0.1, 0.6), 80, 40);
    case 2:
      return box({dice.in(0.1, 2), dice.in(0.2, 2), dice.in(0.5, 2)}, 4);
    default:
      return ellipsoid({dice.in(0.2, 1), dice.in(0.5, 1), 1}, 4);
  }
}

// Returns one to three bodies, separate or intersecting.
std::vector<Mesh> random_bodies(Dice& dice) {
  std::vector<Mesh> bodies;
  const std::size_t n = 1 + dice.below(3);
  for (std::size_t i = 0; i < n; ++i) {
    test::Motion motion =
        test::rotation({dice.in(-1, 1), dice.in(-1, 1), dice.in(0.1, 1)}, dice.in(0, 3));
    motion.scale = dice.in(0.3, 1);
    motion.shift = {dice.in(-1, 1), dice.in(-1, 1), dice.in(-1, 1)};
    bodies.push_back(test::moved(random_body(dice), motion));
  }
  return bodies;
}

// Returns the winding number of the body at each point: near 1 inside, near 0 outside.
std::vector<double> winding_of(const Mesh& body, const std::vector<Vec3>& points) {
  std::vector<Vec3> centers, areas;
  for (const Triangle& t : body.faces) {
    const Vec3 &a = body.vertices[t[0]], &b = body.vertices[t[1]], &c = body.vertices[t[2]];
    centers.push_back((a + b + c) / 3);
    areas.push_back(cross(b - a, c - a) / 2);
  }
  return WindingTree(centers, areas).winding(points);
}

// Samples the surface of the union: points within another body are removed.
PointCloud random_points(Dice& dice, std::string& what) {
  const std::vector<Mesh> bodies = random_bodies(dice);
  SampleOptions options{.points = 300 + dice.below(6000)};
  if (dice.once_in(3)) options.noise = dice.in(0, 0.01);
  if (dice.once_in(3)) options.normal_noise = dice.in(0, 40);
  if (dice.once_in(4)) options.outliers = dice.in(0, 0.3);
  if (dice.once_in(4)) options.holes = 1 + static_cast<int>(dice.below(4));
  options.hole_radius = dice.in(0.02, 0.15);
  if (dice.once_in(4)) options.density_ratio = dice.in(1, 50);
  options.seed = dice.seed;
  const bool keep_inner = dice.once_in(3);
  PointCloud all;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    PointCloud own = sample_surface(bodies[i], options);
    std::vector<char> inner(own.points.size(), 0);
    for (std::size_t j = 0; j < bodies.size() && !keep_inner; ++j) {
      if (i == j) continue;
      const std::vector<double> w = winding_of(bodies[j], own.points);
      for (std::size_t p = 0; p < w.size(); ++p) inner[p] |= w[p] > 0.5;
    }
    for (std::size_t p = 0; p < own.points.size(); ++p) {
      if (inner[p]) continue;
      all.points.push_back(own.points[p]);
      all.normals.push_back(own.normals[p]);
    }
  }
  if (dice.once_in(8)) all.normals.clear();
  what = std::to_string(bodies.size()) + " bodies, " + std::to_string(all.points.size()) +
         " points, noise " + std::to_string(options.noise) + ", normals " +
         std::to_string(options.normal_noise) + ", outliers " + std::to_string(options.outliers) +
         ", holes " + std::to_string(options.holes) + (keep_inner ? ", inner sheets" : "");
  return all;
}

TEST(RandomReconstruct, every_surface_is_a_closed_manifold) {
  int refused = 0;
  for (int i = 0; i < kInputs; ++i) {
    Dice dice{static_cast<std::uint64_t>(1000 + i)};
    std::string what;
    PointCloud cloud = random_points(dice, what);
    SCOPED_TRACE("input " + std::to_string(i) + ": " + what);
    ReconstructOptions options;
    if (dice.once_in(4)) options.tolerance = dice.in(1e-3, 3e-2);
    if (dice.once_in(4)) options.min_component = dice.in(0, 0.3);
    if (dice.once_in(5)) options.keep_outliers = true;
    if (dice.once_in(2)) options.simplify = SimplifyOptions{.share = dice.in(0, 0.5)};
    try {
      const Mesh mesh = reconstruct(cloud, options).mesh;
      validate(mesh);
      const Inspection found = inspect(mesh);
      EXPECT_EQ(found.boundary_edges, 0U);
      EXPECT_EQ(found.non_manifold_edges, 0U);
      EXPECT_EQ(found.non_manifold_vertices, 0U);
      EXPECT_EQ(found.misoriented_edges, 0U);
      EXPECT_GT(found.faces, 0U);
      EXPECT_GT(found.volume, 0);
      options.holes = HolePolicy::kKeep;
      const Inspection open = inspect(reconstruct(std::move(cloud), options).mesh);
      EXPECT_EQ(open.non_manifold_edges + open.non_manifold_vertices + open.misoriented_edges, 0U);
    } catch (const Error& error) {
      EXPECT_TRUE(error.code() == ErrorCode::kInvalidInput ||
                  error.code() == ErrorCode::kOutOfMemory)
          << error.what();
      ++refused;
    }
  }
  EXPECT_LE(refused, kInputs / 50);
}

}  // namespace
}  // namespace rholm
