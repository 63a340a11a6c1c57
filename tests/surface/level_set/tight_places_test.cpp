// Places where normals turn fast, and their neighbourhoods. Oracles examine every edge by angles,
// and every place by cubes.
#include "surface/level_set/tight_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <set>
#include <vector>

#include "rholm/primitives.h"
#include "support/random_data.h"
#include "support/test_shapes.h"
#include "surface/level_set/mesh_piece.h"

namespace rholm {
namespace {

Vec3 random_point(double half, std::uint64_t seed, std::uint64_t i) {
  return half * Vec3{test::random_in(-1, 1, seed, 3 * i), test::random_in(-1, 1, seed, 3 * i + 1),
                     test::random_in(-1, 1, seed, 3 * i + 2)};
}

// Compares the chord of each edge with the part of a full turn that the edge is of the length.
std::set<std::uint32_t> sharp_by_edges(const Mesh& mesh, const NormalAttributes& normals,
                                       double length) {
  std::set<std::uint32_t> sharp;
  for (const Triangle& t : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const double edge =
          std::clamp(norm(mesh.vertices[b] - mesh.vertices[a]), length / 30, length / 2);
      const double turn = 2 * std::numbers::pi * edge / length;
      const bool known = norm(normals[a]) > 0 && norm(normals[b]) > 0;
      if (known && norm(normals[b] - normals[a]) < turn - std::pow(turn, 3) / 24) continue;
      sharp.insert({a, b});
    }
  }
  return sharp;
}

TEST(sharp_vertices, are_those_of_edges_along_which_normals_turn_as_a_short_curve) {
  for (const double noise : {0.0, 0.02, 0.1, 0.5}) {
    Mesh mesh = torus(2, 0.5, 60, 20);
    test::add_normals(mesh);
    const NormalAttributes normals = normal_attributes(mesh);
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      normals.set(v, normalized(normals[v] + random_point(noise, 1, v)));
    }
    normals.set(7, {});  // an unknown normal counts as sharp, with its neighbours
    for (const double length : {0.3, 1.0, 3.0, 10.0}) {
      const std::vector<std::uint32_t> found =
          sharp_vertices(mesh, normals, length, mesh.vertices.size(), {});
      const std::set<std::uint32_t> expected = sharp_by_edges(mesh, normals, length);
      EXPECT_TRUE(std::equal(found.begin(), found.end(), expected.begin(), expected.end()))
          << noise << " " << length << ": " << found.size() << " of " << expected.size();
    }
  }
}

TEST(NearPlaces, are_those_whose_cubes_touch_that_of_a_center) {
  constexpr double kReach = 0.3;
  std::vector<Vec3> centers;
  centers.reserve(40);
  for (std::uint64_t i = 0; i < 40; ++i) centers.push_back(random_point(5, 2, i));
  const NearPlaces near(centers, kReach);
  const auto cubes_between = [&](double a, double b) {
    return std::abs(std::floor(a / kReach) - std::floor(b / kReach));
  };
  std::size_t n_near = 0;
  for (std::uint64_t i = 0; i < 20000; ++i) {
    const Vec3 x = random_point(6, 3, i);
    const bool expected = std::any_of(centers.begin(), centers.end(), [&](const Vec3& c) {
      return std::max(
                 {cubes_between(c.x, x.x), cubes_between(c.y, x.y), cubes_between(c.z, x.z)}) <= 1;
    });
    ASSERT_EQ(near.has(x), expected) << i;
    n_near += expected ? 1 : 0;
  }
  EXPECT_GT(n_near, 100U);
}

}  // namespace
}  // namespace rholm
