#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/disjoint_sets.h"
#include "rholm/error.h"
#include "rholm/outward.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "support/random_data.h"
#include "support/test_meshes.h"

namespace rholm {
namespace {

using test::exploded;
using test::random_in;

TEST(weld, of_a_soup_gives_the_mesh_back) {
  for (const double tolerance : {0.0, 1e-12, 1e-3}) {
    const Mesh mesh = icosphere(3);
    const Welded welded = weld(exploded(mesh), tolerance);
    EXPECT_EQ(welded.mesh.vertices.size(), mesh.vertices.size());
    EXPECT_EQ(welded.merged_vertices, 3 * mesh.faces.size() - mesh.vertices.size());
    EXPECT_EQ(welded.collapsed_faces, 0u);
    ASSERT_EQ(welded.mesh.faces.size(), mesh.faces.size());
    for (std::size_t t = 0; t < mesh.faces.size(); ++t) {
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(welded.mesh.vertices[welded.mesh.faces[t][k]], mesh.vertices[mesh.faces[t][k]]);
      }
    }
  }
}

TEST(outward, welds_and_turns_what_is_inside_out_and_nothing_else) {
  const Mesh right = icosphere(2);
  Mesh turned = right;
  flip(turned);
  for (const Mesh& mesh : {right, turned}) {
    const Outward shape = outward(exploded(mesh));
    EXPECT_EQ(shape.flipped, enclosed_volume(mesh) < 0);
    EXPECT_EQ(shape.welded.mesh.vertices.size(), right.vertices.size());
    EXPECT_GT(enclosed_volume(shape.welded.mesh), 0);
  }
  // An open mesh has no inside, whatever the sign of its volume.
  turned.faces.pop_back();
  ASSERT_LT(enclosed_volume(turned), 0);
  const Outward open = outward(turned);
  EXPECT_FALSE(open.flipped);
  EXPECT_EQ(open.welded.mesh.faces, turned.faces);
}

TEST(weld, takes_zero_and_minus_zero_as_one_and_keeps_neighbouring_doubles_apart) {
  const double next = std::nextafter(1.0, 2.0);
  const Mesh mesh{
      .vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {next, 0, 0}, {0, 0, 1}},
      .faces = {{0, 1, 2}, {3, 4, 5}},
      .attributes = {}};
  const Welded welded = weld(mesh);
  EXPECT_EQ(welded.merged_vertices, 1u);
  EXPECT_EQ(welded.mesh.faces[1], (Triangle{0, 3, 4}));
}

TEST(weld, keeps_order_first_vertices_and_their_attributes_and_drops_unused_ones) {
  const Mesh mesh{.vertices = {{9, 9, 9}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 0}},
                  .faces = {{3, 2, 4}, {5, 3, 2}},
                  .attributes = {{.name = "quality", .values = {0, 1, 2, 3, 4, 5}}}};
  const Welded welded = weld(mesh);
  EXPECT_EQ(welded.mesh.vertices, (std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(welded.mesh.attributes[0].values, (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(welded.mesh.faces, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(welded.merged_vertices, 2u);
  EXPECT_EQ(welded.collapsed_faces, 1u);
}

TEST(weld, joins_chains_of_vertices_within_the_tolerance) {
  Mesh mesh;
  for (int i = 0; i <= 20; ++i) mesh.vertices.push_back({i * 1.0, 0, 0});
  mesh.vertices.insert(mesh.vertices.end(), {{100, 0, 0}, {0, 100, 0}, {0, 0, 100}});
  mesh.faces = {{20, 21, 22}, {0, 22, 23}};
  EXPECT_EQ(weld(mesh, 0.999).merged_vertices, 0u);
  EXPECT_EQ(weld(mesh, 1).merged_vertices, 20u);
  EXPECT_EQ(weld(mesh, 1).mesh.faces[0][0], weld(mesh, 1).mesh.faces[1][0]);
}

// Random points in clusters; the oracle compares all pairs.
TEST(weld, with_a_tolerance_agrees_with_the_comparison_of_all_pairs) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    constexpr std::uint32_t n = 300;
    Mesh mesh;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint64_t cluster = random_bits(seed + 100, i) % 20;
      Vec3 v;
      double* const parts[3] = {&v.x, &v.y, &v.z};
      for (int k = 0; k < 3; ++k) {
        *parts[k] =
            random_in(-1, 1, seed, 3 * cluster + k) + random_in(-0.1, 0.1, seed + 50, 3 * i + k);
      }
      mesh.vertices.push_back(v);
    }
    for (std::uint32_t i = 0; i < n; i += 3) mesh.faces.push_back({i, i + 1, i + 2});
    for (const double tolerance : {1e-6, 0.02, 0.05, 0.1, 0.5, 10.0}) {
      DisjointSets sets(n);
      std::size_t merged = 0;
      for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < i; ++j) {
          if (norm(mesh.vertices[i] - mesh.vertices[j]) <= tolerance) sets.unite(i, j);
        }
      }
      for (std::uint32_t i = 0; i < n; ++i) merged += sets.find(i) != i;
      const Welded welded = weld(mesh, tolerance);
      EXPECT_EQ(welded.merged_vertices, merged) << seed << " " << tolerance;
      EXPECT_EQ(welded.mesh.faces.size() + welded.collapsed_faces, n / 3);
    }
  }
}

TEST(weld, works_at_every_scale) {
  for (const double scale : {1e-300, 1e-30, 1e30, 1e300}) {
    Mesh mesh = exploded(box({scale, scale, scale}, 3));
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      mesh.vertices[i].x += random_in(-1e-9, 1e-9, 1, i) * scale;
    }
    const Welded welded = weld(mesh, 1e-8 * scale);
    EXPECT_EQ(welded.mesh.vertices.size(), 56u) << scale;
    EXPECT_TRUE(inspect(welded.mesh).closed) << scale;
    // Tolerances are far below the spacing of doubles, and far above the size.
    EXPECT_EQ(weld(mesh, std::numeric_limits<double>::denorm_min()).merged_vertices, 0u);
    EXPECT_TRUE(weld(mesh, 1e4 * scale).mesh.vertices.empty());
  }
}

TEST(weld, refuses_bad_tolerances_and_bad_meshes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(weld(icosphere(0), -1), Error);
  EXPECT_THROW(weld(icosphere(0), nan), Error);
  Mesh mesh = icosphere(0);
  mesh.vertices[3].y = nan;
  EXPECT_THROW(weld(mesh), Error);
  EXPECT_TRUE(weld(Mesh{}).mesh.faces.empty());
  EXPECT_TRUE(weld(Mesh{}, 1).mesh.faces.empty());
}

}  // namespace
}  // namespace rholm
