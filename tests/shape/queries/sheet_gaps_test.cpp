// Expected values are distances between the faces of boxes, and winding numbers of nested spheres.
#include "shape/queries/sheet_gaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "rholm/primitives.h"
#include "rholm/topology.h"

namespace rholm {
namespace {

Mesh both(const Mesh& a, const Mesh& b, const Vec3& moved = {}) {
  Mesh mesh = a;
  const auto n = static_cast<std::uint32_t>(a.vertices.size());
  for (const Vec3& v : b.vertices) mesh.vertices.push_back(v + moved);
  for (const Triangle& t : b.faces) mesh.faces.push_back({t[0] + n, t[1] + n, t[2] + n});
  return mesh;
}

Mesh scaled(Mesh mesh, double factor) {
  for (Vec3& v : mesh.vertices) v = factor * v;
  return mesh;
}

// One point of each triangle, away from its middle.
struct Points {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> faces;
};
Points points_of(const Mesh& mesh) {
  Points on;
  for (std::uint32_t t = 0; t < mesh.faces.size(); ++t) {
    const auto& [a, b, c] = mesh.faces[t];
    on.points.push_back(0.31 * mesh.vertices[a] + 0.29 * mesh.vertices[b] + 0.4 * mesh.vertices[c]);
    on.faces.push_back(t);
  }
  return on;
}

std::vector<int> winding_of(const Mesh& mesh) {
  const Points on = points_of(mesh);
  const RayScene scene(mesh);
  return outer_winding({mesh, on.points, on.faces}, scene, {});
}

TEST(sheet_gaps, of_a_box_are_its_sides) {
  for (const double scale : {1.0, 1e-9, 1e9}) {
    const Mesh mesh = scaled(box({1, 2, 0.1}, 4), scale);
    const Points on = points_of(mesh);
    const RayScene scene(mesh);
    const std::vector<double> gaps = sheet_gaps({mesh, on.points, on.faces}, scene, {});
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      const Vec3 p = on.points[i] / scale;
      const double side = std::abs(p.x) > 0.4999 ? 1 : std::abs(p.y) > 0.9999 ? 2 : 0.1;
      EXPECT_NEAR(gaps[i], side * scale, 1e-6 * scale);
    }
  }
}

TEST(sheet_gaps, are_seen_through_the_air_as_well_and_nowhere_across_an_open_sheet) {
  const Mesh one = box({1, 1, 1}, 3);
  const Mesh mesh = both(one, one, {0, 0, 1.03});
  const Points on = points_of(mesh);
  const RayScene scene(mesh);
  const std::vector<double> gaps = sheet_gaps({mesh, on.points, on.faces}, scene, {});
  EXPECT_NEAR(*std::min_element(gaps.begin(), gaps.end()), 0.03, 1e-6);
  EXPECT_EQ(std::count_if(gaps.begin(), gaps.end(), [](double g) { return g < 0.5; }), 2 * 18);
  const Mesh sheet{
      .vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .faces = {{0, 1, 2}}, .attributes = {}};
  const Points of_sheet = points_of(sheet);
  const RayScene alone(sheet);
  EXPECT_TRUE(std::isinf(sheet_gaps({sheet, of_sheet.points, of_sheet.faces}, alone, {})[0]));
}

TEST(sheet_gaps, of_a_flat_solid_are_zero) {
  const Mesh mesh{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                  .faces = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}},
                  .attributes = {}};
  const Points on = points_of(mesh);
  const RayScene scene(mesh);
  for (const double gap : sheet_gaps({mesh, on.points, on.faces}, scene, {})) {
    EXPECT_LT(gap, 2e-6);
  }
}

TEST(outer_winding, tells_what_other_parts_enclose) {
  const Mesh outer = icosphere(3), inner = scaled(icosphere(2), 0.5);
  const std::size_t n = outer.faces.size();
  const std::vector<int> nested = winding_of(both(outer, inner));
  EXPECT_TRUE(std::all_of(nested.begin(), nested.begin() + static_cast<std::ptrdiff_t>(n),
                          [](int w) { return w == 0; }));
  EXPECT_TRUE(std::all_of(nested.begin() + static_cast<std::ptrdiff_t>(n), nested.end(),
                          [](int w) { return w == 1; }));
  // The wall of a cavity faces the cavity: it bounds the solid.
  Mesh wall = inner;
  flip(wall);
  for (const int w : winding_of(both(outer, wall))) EXPECT_EQ(w, 0);
  Mesh inverted = outer;
  flip(inverted);
  for (const int w : winding_of(inverted)) EXPECT_EQ(w, -1);
}

// Two boxes share the corner [0, 1/2]^3: the parts of each box in the other are enclosed once.
TEST(outer_winding, counts_the_enclosed_parts_of_crossing_boxes) {
  const Mesh one = box({1, 1, 1}, 8);
  const Mesh mesh = both(one, one, {0.5, 0.5, 0.5});
  const Points on = points_of(mesh);
  const std::vector<int> winding = winding_of(mesh);
  for (std::size_t i = 0; i < winding.size(); ++i) {
    const bool second = i >= one.faces.size();
    const Vec3 p = on.points[i] - (second ? Vec3{} : Vec3{0.5, 0.5, 0.5});
    const auto within = [](double x) { return std::abs(x) < 0.5; };
    EXPECT_EQ(winding[i], within(p.x) && within(p.y) && within(p.z) ? 1 : 0) << i;
  }
}

TEST(outer_winding, does_not_let_a_doubled_sheet_enclose_itself) {
  const Mesh one = box({1, 1, 1}, 3);
  for (const int w : winding_of(both(one, one))) EXPECT_EQ(w, 0);
}

}  // namespace
}  // namespace rholm
