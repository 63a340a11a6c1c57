#include "shape/queries/triangle_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "rholm/primitives.h"
#include "support/random_data.h"
#include "support/test_meshes.h"

namespace rholm {
namespace {

std::vector<Triangle> triangles_of(const MeshView& mesh) {
  std::vector<Triangle> all;
  all.reserve(mesh.n_faces);
  for (std::size_t t = 0; t < mesh.n_faces; ++t) all.push_back(mesh.triangle(t));
  return all;
}

Mesh shuffled_sphere(bool vertices_too, int subdivisions = 5) {
  Mesh mesh = icosphere(subdivisions);
  test::shuffle(mesh.faces, 1);
  if (!vertices_too) return mesh;
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  test::shuffle(order, 2);
  return test::renumbered(mesh, order);
}

// Returns the mean distance between the first corners of consecutive triangles.
double mean_step(const MeshView& mesh) {
  double sum = 0;
  for (std::size_t t = 1; t < mesh.n_faces; ++t) {
    sum += norm(mesh.vertex(mesh.triangle(t)[0]) - mesh.vertex(mesh.triangle(t - 1)[0]));
  }
  return sum / static_cast<double>(mesh.n_faces - 1);
}

constexpr TriangleKey kKeys[] = {TriangleKey::kVertex, TriangleKey::kPosition};

TEST(triangle_order, keeps_every_triangle_once) {
  const Mesh mesh = shuffled_sphere(true);
  for (const TriangleKey key : kKeys) {
    std::vector<Triangle> sorted =
        triangles_of(order_triangles(view_of(mesh), key, {}, {}, {}).view);
    std::vector<Triangle> expected = mesh.faces;
    std::sort(sorted.begin(), sorted.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(sorted, expected);
  }
}

TEST(triangle_order, smallest_corners_ascend_by_vertex) {
  const Mesh mesh = shuffled_sphere(false);
  const OrderedTriangles ordered = order_triangles(view_of(mesh), TriangleKey::kVertex, {}, {}, {});
  std::uint32_t last = 0;
  for (const Triangle& t : triangles_of(ordered.view)) {
    const std::uint32_t least = std::min({t[0], t[1], t[2]});
    EXPECT_LE(last, least);
    last = least;
  }
}

// A curve through n cells of the unit sphere has steps of about sqrt(4 pi / n). Random points have
// a distance of 4/3.
TEST(triangle_order, neighbours_are_near_by_position) {
  const Mesh mesh = shuffled_sphere(true);
  const double n = static_cast<double>(mesh.faces.size());
  EXPECT_GT(mean_step(view_of(mesh)), 1.3);
  const OrderedTriangles ordered =
      order_triangles(view_of(mesh), TriangleKey::kPosition, {}, {}, {});
  EXPECT_LT(mean_step(ordered.view), 3 * std::sqrt(4 * 3.14159265358979 / n));
}

TEST(triangle_order, is_the_same_for_any_number_of_threads) {
  const Mesh mesh = shuffled_sphere(true, 7);  // two parts
  for (const TriangleKey key : kKeys) {
    const auto with = [&](int threads) {
      return triangles_of(order_triangles(view_of(mesh), key, {}, {}, {.threads = threads}).view);
    };
    EXPECT_EQ(with(1), with(3));
  }
}

TEST(triangle_order, visits_every_triangle_before_it_is_read) {
  const Mesh mesh = shuffled_sphere(false);
  std::size_t before = 0, after = 0;
  order_triangles(
      view_of(mesh), TriangleKey::kVertex,
      [&](std::size_t first, std::size_t n) {
        EXPECT_EQ(first, before);
        before += n;
      },
      [&](std::size_t, std::size_t n) { after += n; }, {.threads = 1});
  EXPECT_EQ(before, mesh.faces.size());
  EXPECT_EQ(after, 2 * mesh.faces.size());  // it is read twice
}

TEST(triangle_order, keeps_what_is_out_of_range_or_nowhere) {
  Mesh mesh = shuffled_sphere(true);
  mesh.faces[5] = {4000000000U, 1, 2};
  mesh.vertices[7] = {std::nan(""), std::numeric_limits<double>::infinity(), -1e300};
  for (const TriangleKey key : kKeys) {
    std::vector<Triangle> sorted =
        triangles_of(order_triangles(view_of(mesh), key, {}, {}, {}).view);
    EXPECT_EQ(std::count(sorted.begin(), sorted.end(), mesh.faces[5]), 1);
    EXPECT_EQ(sorted.size(), mesh.faces.size());
  }
}

TEST(triangle_order, small_and_flat_meshes) {
  for (const Mesh& mesh : {test::tetrahedron(), Mesh{{{1, 1, 1}, {1, 1, 1}}, {{0, 1, 0}}, {}}}) {
    for (const TriangleKey key : kKeys) {
      EXPECT_EQ(order_triangles(view_of(mesh), key, {}, {}, {}).view.n_faces, mesh.faces.size());
    }
  }
}

TEST(triangle_order, vertices_of_a_grid_are_in_order_and_shuffled_ones_are_not) {
  EXPECT_TRUE(vertices_in_order(view_of(box({1, 1, 1}, 40))));
  EXPECT_FALSE(vertices_in_order(view_of(shuffled_sphere(true))));
  EXPECT_TRUE(vertices_in_order(view_of(Mesh{{{1, 2, 3}}, {}, {}})));
}

}  // namespace
}  // namespace rholm
