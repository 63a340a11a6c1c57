// From an atlas to a mesh: closed or open, whole or in parts, within the memory allowed.
#include "surface/atlas_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "atlas/cover/cap_cover.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "support/test_points.h"

namespace rholm {
namespace {

Atlas atlas_of(const PointCloud& cloud) {
  const PointTree tree(cloud.points);
  std::vector<Vec3> points, normals;
  for (const std::uint32_t i : tree.order()) {
    points.push_back(cloud.points[i]);
    normals.push_back(cloud.normals[i]);
  }
  Cover made = cover({tree, points, normals}, {}, {});
  Atlas atlas;
  atlas.caps = std::move(made.caps);
  atlas.coefficients = std::move(made.coefficients);
  atlas.diagonal = bounds(points).diagonal();
  return atlas;
}

PointCloud sphere_at(const Vec3& center, double radius, std::size_t n) {
  PointCloud cloud = test::sphere_points(n);
  for (Vec3& p : cloud.points) p = center + radius * p;
  return cloud;
}

Inspection expect_closed(const Mesh& mesh) {
  const Inspection found = inspect(mesh);
  EXPECT_TRUE(found.closed && found.manifold && found.oriented && !found.inside_out);
  return found;
}

void expect_unit_normals(const Mesh& mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 n{find_attribute(mesh.attributes, "nx")->values[v],
                 find_attribute(mesh.attributes, "ny")->values[v],
                 find_attribute(mesh.attributes, "nz")->values[v]};
    ASSERT_NEAR(norm(n), 1, 1e-6);
  }
}

TEST(AtlasSurface, of_a_sphere_is_closed_at_every_step) {
  const Atlas atlas = atlas_of(sphere_at({}, 1, 2000));
  const double spacing = std::sqrt(4 * std::numbers::pi / 2000);
  std::size_t before = 0;
  for (const double part : {2.0, 1.0, 0.5, 0.25}) {
    const AtlasSurface made = extract_atlas(atlas, {.step = part * spacing});
    const Inspection found = expect_closed(made.mesh);
    EXPECT_EQ(found.euler_characteristic, 2);
    // Half the step gives four times the triangles.
    if (before > 0) {
      EXPECT_NEAR(static_cast<double>(found.faces) / static_cast<double>(before), 4, 0.5);
    }
    before = found.faces;
    expect_unit_normals(made.mesh);
  }
}

TEST(AtlasSurface, parts_are_dropped_by_their_area) {
  const Atlas atlas =
      atlas_of(test::joined(sphere_at({}, 1, 3000), sphere_at({2, 0, 0}, 0.3, 300)));
  EXPECT_EQ(expect_closed(extract_atlas(atlas, {.step = 0.06, .min_component = 0}).mesh).components,
            2U);
  const AtlasSurface one = extract_atlas(atlas, {.step = 0.06, .min_component = 0.15});
  EXPECT_EQ(one.dropped_components, 1U);
  EXPECT_EQ(expect_closed(one.mesh).components, 1U);
  EXPECT_LT(inspect(one.mesh).bounds.max.x, 1.01);
}

TEST(AtlasSurface, holes_are_closed_or_cut_out) {
  PointCloud open;
  for (const Vec3& p : test::sphere_points(6000).points) {
    if (std::abs(p.z) < 0.85) open.points.push_back(p);
  }
  open.normals = open.points;
  const Atlas atlas = atlas_of(open);
  const AtlasSurface closed = extract_atlas(atlas, {.step = 0.035});
  EXPECT_EQ(expect_closed(closed.mesh).euler_characteristic, 2);
  EXPECT_GE(closed.holes, 2U);  // the hole and gaps between random points
  expect_unit_normals(closed.mesh);
  const AtlasSurface kept = extract_atlas(atlas, {.step = 0.035, .keep_holes = true});
  const Inspection found = inspect(kept.mesh);
  EXPECT_TRUE(found.manifold && found.oriented);
  EXPECT_EQ(found.euler_characteristic, 0);  // a ring with two borders
  EXPECT_GT(found.boundary_edges, 0U);
}

TEST(AtlasSurface, memory_is_foreseen_and_kept) {
  const Atlas atlas = atlas_of(sphere_at({}, 1, 2000));
  const std::size_t needed = extract_atlas(atlas, {.step = 0.05}).memory;
  EXPECT_NO_THROW(extract_atlas(atlas, {.step = 0.05, .max_memory = 2 * needed}));
  try {
    extract_atlas(atlas, {.step = 0.05, .max_memory = needed / 2});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kOutOfMemory);
    EXPECT_NE(std::string(error.what()).find("0.05"), std::string::npos) << error.what();
  }
}

TEST(AtlasSurface, is_simplified_as_far_as_wanted) {
  const Atlas atlas = atlas_of(sphere_at({1, 2, 3}, 1, 4000));
  const AtlasSurface full = extract_atlas(atlas, {.step = 0.05});
  EXPECT_EQ(full.faces, full.mesh.faces.size());
  EXPECT_EQ(full.simplify_error, 0);
  const AtlasSurface tenth =
      extract_atlas(atlas, {.step = 0.05, .simplify = SimplifyOptions{.share = 0.1}});
  EXPECT_EQ(tenth.faces, full.faces);
  EXPECT_LE(tenth.mesh.faces.size(), full.faces / 10);
  EXPECT_EQ(expect_closed(tenth.mesh).euler_characteristic, 2);
  expect_unit_normals(tenth.mesh);
  // Without a number, the step determines the allowed error.
  const AtlasSurface chosen = extract_atlas(atlas, {.step = 0.05, .simplify = SimplifyOptions{}});
  EXPECT_GT(chosen.simplify_error, 0);
  EXPECT_LE(chosen.simplify_error, 0.05 / 50 * (1 + 1e-5));
  EXPECT_LT(chosen.mesh.faces.size(), full.faces);
  EXPECT_GT(chosen.memory, full.memory);
}

TEST(AtlasSurface, is_the_same_for_every_number_of_threads) {
  const Atlas atlas = atlas_of(sphere_at({1, 2, 3}, 1, 3000));
  const Mesh one = extract_atlas(atlas, {.step = 0.04}, {.threads = 1}).mesh;
  const Mesh two = extract_atlas(atlas, {.step = 0.04}, {.threads = 2}).mesh;
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.faces, two.faces);
}

}  // namespace
}  // namespace rholm
