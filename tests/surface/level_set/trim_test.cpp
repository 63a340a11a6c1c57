// Trimming, and dropping of small components. Oracles are counts by inspect() and circles on the
// sphere.
#include "surface/level_set/trim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "base/random.h"
#include "rholm/error.h"
#include "rholm/topology.h"
#include "surface/field/field_grid.h"
#include "surface/level_set/components.h"
#include "surface/level_set/extract.h"

namespace rholm {
namespace {

using std::numbers::pi;
using test::box_grid;
using test::fill_grid;

constexpr double kStep = 0.05;

Mesh sphere() {
  BlockGrid grid = box_grid({0.003, 0.007, -0.002}, kStep, -3, 3);
  fill_grid(grid, [](const Vec3& x) { return norm(x) - 1; });
  return extract_surface(grid).mesh;
}

// Returns edges with a triangle on one side only.
std::vector<std::pair<Vec3, Vec3>> border(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Triangle& t : mesh.faces) {
    for (int k = 0; k < 3; ++k) ++sides[std::minmax(t[k], t[(k + 1) % 3])];
  }
  std::vector<std::pair<Vec3, Vec3>> edges;
  for (const auto& [edge, n] : sides) {
    if (n == 1) edges.emplace_back(mesh.vertices[edge.first], mesh.vertices[edge.second]);
  }
  return edges;
}

TEST(Trim, border_of_a_cut_sphere_is_a_circle) {
  const Mesh whole = sphere();
  for (const double z : {-0.4, 0.0, 0.61}) {
    std::vector<double> support;
    support.reserve(whole.vertices.size());
    for (const Vec3& v : whole.vertices) support.push_back(z - v.z);
    const Mesh cut = trim(whole, support);
    const Inspection found = inspect(cut);
    EXPECT_EQ(found.euler_characteristic, 1);
    EXPECT_EQ(found.components, 1U);
    EXPECT_TRUE(found.manifold && found.oriented);
    EXPECT_EQ(found.isolated_vertices, 0U);
    EXPECT_EQ(found.degenerate_faces, 0U);
    // The cut moves the border by a tenth of an edge, which has at most sqrt(3) steps. Smoothing
    // then changes z on an irregular mesh.
    double length = 0;
    for (const auto& [a, b] : border(cut)) {
      EXPECT_NEAR(a.z, z, 0.4 * kStep);
      length += norm(a - b);
    }
    const double circle = 2 * pi * std::sqrt(1 - z * z);
    EXPECT_NEAR(length, circle, 0.05 * circle);
    const double area = 2 * pi * (1 + z);
    EXPECT_NEAR(found.area, area, circle * 0.3 * kStep + area * kStep * kStep);
  }
}

TEST(Trim, random_support_leaves_a_manifold) {
  const Mesh whole = sphere();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::vector<double> support(whole.vertices.size());
    for (std::size_t v = 0; v < support.size(); ++v) {
      support[v] = random_uniform(seed, v) - 0.5;
      if (v % 7 == 0) support[v] = 0;
    }
    const Inspection found = inspect(trim(whole, support, static_cast<int>(seed % 3)));
    EXPECT_TRUE(found.manifold && found.oriented);
    EXPECT_EQ(found.isolated_vertices, 0U);
  }
}

TEST(Trim, attributes_are_interpolated) {
  Mesh whole = sphere();
  Attribute x{.name = "x", .type = ScalarType::kFloat64, .values = {}};
  std::vector<double> support;
  for (const Vec3& v : whole.vertices) {
    x.values.push_back(v.x);
    support.push_back(0.1 - v.x * v.y);
  }
  whole.attributes.push_back(x);
  const Mesh cut = trim(whole, support, 0);
  const auto n_inner = static_cast<std::size_t>(
      std::count_if(support.begin(), support.end(), [](double s) { return s > 0; }));
  ASSERT_EQ(cut.attributes.size(), 1U);
  for (std::size_t v = 0; v < cut.vertices.size(); ++v) {
    // The border is smoothed after the cut.
    EXPECT_NEAR(cut.attributes[0].values[v], cut.vertices[v].x, v < n_inner ? 1e-12 : kStep);
  }
}

TEST(Trim, full_support_keeps_all_and_none_keeps_nothing) {
  const Mesh whole = sphere();
  const Mesh kept = trim(whole, std::vector<double>(whole.vertices.size(), 1));
  EXPECT_EQ(kept.vertices, whole.vertices);
  EXPECT_EQ(kept.faces, whole.faces);
  EXPECT_TRUE(trim(whole, std::vector<double>(whole.vertices.size(), 0)).vertices.empty());
  EXPECT_THROW(trim(whole, std::vector<double>(3, 1)), Error);
  EXPECT_THROW(trim(whole, std::vector<double>(whole.vertices.size(), NAN)), Error);
}

// Balls of radius 1, 1/2 and 1/8: areas 1, 1/4, 1/64, volumes 1, 1/8, 1/512 of the largest.
Mesh three_balls() {
  BlockGrid grid = box_grid({0.003, 0.007, -0.002}, kStep, -3, 8);
  fill_grid(grid, [](const Vec3& x) {
    return std::min({norm(x - Vec3{0, 0, 0}) - 1, norm(x - Vec3{1.9, 0, 0}) - 0.5,
                     norm(x - Vec3{0, 1.5, 1}) - 0.125});
  });
  return extract_surface(grid).mesh;
}

TEST(Components, those_below_the_share_are_dropped) {
  for (const auto& [share, left] : {std::pair{0.0, 3U}, {0.01, 3U}, {0.02, 2U}, {0.3, 1U}}) {
    Mesh mesh = three_balls();
    const double area = inspect(mesh).area;
    const DroppedComponents dropped = drop_small_components(mesh, share);
    EXPECT_EQ(dropped.components, 3U);
    EXPECT_EQ(dropped.dropped, 3 - left);
    const Inspection found = inspect(mesh);
    EXPECT_EQ(found.components, left);
    EXPECT_TRUE(found.closed && found.manifold);
    EXPECT_EQ(found.isolated_vertices, 0U);
    EXPECT_NEAR(dropped.dropped_area, 1 - found.area / area, 1e-12);
  }
}

TEST(Components, a_flat_bubble_has_area_but_no_volume) {
  BlockGrid grid = box_grid({0.003, 0.007, -0.002}, kStep, -4, 4);
  fill_grid(grid, [](const Vec3& x) {
    const double ball = norm(x + Vec3{0, 0, 0.6}) - 0.8;
    const double plate = std::max(std::hypot(x.x, x.y) - 0.7, std::abs(x.z - 0.8) - 0.02);
    return std::min(ball, plate);
  });
  Mesh mesh = extract_surface(grid).mesh;
  EXPECT_EQ(inspect(mesh).components, 2U);
  // The plate has a third of the ball's area, and 1/35 of its volume: 0.15^1.5 is 1/17.
  EXPECT_EQ(drop_small_components(mesh, 0.15).dropped, 1U);
  EXPECT_EQ(inspect(mesh).components, 1U);
}

TEST(Components, an_empty_mesh_has_none) {
  Mesh mesh;
  EXPECT_EQ(drop_small_components(mesh, 0.1).components, 0U);
}

}  // namespace
}  // namespace rholm
