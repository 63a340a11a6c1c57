#include "rholm/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "base/random.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "shape/repair/hole_closing.h"
#include "shape/repair/sheets.h"
#include "support/random_data.h"
#include "support/test_meshes.h"

namespace rholm {
namespace {

using test::joined;
using test::random_in;
using test::tetrahedron;

// Checks the promise of 'repair' for a damaged solid: closed, manifold, oriented, outwards.
void expect_solid(const Inspection& i, std::size_t components) {
  EXPECT_TRUE(i.closed);
  EXPECT_TRUE(i.manifold);
  EXPECT_TRUE(i.oriented);
  EXPECT_FALSE(i.inside_out);
  EXPECT_EQ(i.duplicate_faces, 0u);
  EXPECT_EQ(i.degenerate_faces, 0u);
  EXPECT_EQ(i.components, components);
}

Mesh shifted(Mesh mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
  return mesh;
}

Mesh scaled(Mesh mesh, double factor) {
  for (Vec3& v : mesh.vertices) v *= factor;
  return mesh;
}

TEST(repair, leaves_a_good_mesh_as_it_is) {
  const Mesh mesh = icosphere(3);
  const Repaired result = repair(mesh);
  EXPECT_EQ(result.mesh.vertices, mesh.vertices);
  EXPECT_EQ(result.mesh.faces, mesh.faces);
  EXPECT_EQ(result.report.flipped_faces, 0u);
  EXPECT_EQ(result.report.closed_holes, 0u);
}

TEST(repair, of_mixed_orientation_turns_the_smaller_part_and_keeps_the_volume) {
  const Mesh mesh = icosphere(3);
  for (const double share : {0.1, 0.3, 0.9}) {
    Mesh mixed = mesh;
    std::size_t turned = 0;
    for (std::size_t t = 0; t < mixed.faces.size(); ++t) {
      if (random_in(0, 1, 7, t) > share) continue;
      std::swap(mixed.faces[t][1], mixed.faces[t][2]);
      ++turned;
    }
    const Repaired result = repair(mixed);
    expect_solid(result.report.after, 1);
    EXPECT_EQ(result.report.flipped_faces, turned) << share;
    EXPECT_EQ(enclosed_volume(result.mesh), enclosed_volume(mesh));
  }
}

// The orientation of a part follows most of its area, not its first face.
TEST(repair, turns_the_first_face_where_it_alone_is_wrong) {
  const Mesh mesh = icosphere(1);
  Mesh mixed = mesh;
  std::swap(mixed.faces[0][1], mixed.faces[0][2]);
  const Repaired result = repair(mixed);
  EXPECT_EQ(result.report.flipped_faces, 1u);
  EXPECT_EQ(result.report.inside_out_parts, 0u);
  EXPECT_EQ(enclosed_volume(result.mesh), enclosed_volume(mesh));
}

TEST(repair, drops_duplicates_of_either_sense_needles_and_unused_vertices) {
  Mesh mesh = icosphere(2);
  const std::size_t n = mesh.faces.size();
  for (std::size_t t = 0; t < n; t += 2) {
    Triangle again = mesh.faces[t];
    if (t % 4 == 0) std::swap(again[0], again[1]);
    mesh.faces.push_back(again);
  }
  mesh.vertices.push_back({9, 9, 9});
  const Repaired result = repair(mesh);
  expect_solid(result.report.after, 1);
  EXPECT_EQ(result.report.duplicate_faces, n / 2);
  EXPECT_EQ(result.report.isolated_vertices, 1u);
  EXPECT_EQ(result.mesh.faces.size(), n);
}

// The edge from 0 to 1 of a tetrahedron has a vertex in its middle in one face only. A triangle
// without area lies in between.
TEST(repair, swaps_a_sliver_for_two_triangles_with_area) {
  const Mesh mesh{.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
                  .faces = {{0, 2, 4}, {4, 2, 1}, {0, 4, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}},
                  .attributes = {}};
  ASSERT_EQ(inspect(mesh).degenerate_faces, 1u);
  ASSERT_TRUE(inspect(mesh).closed);
  const Repaired result = repair(mesh);
  expect_solid(result.report.after, 1);
  EXPECT_EQ(result.report.degenerate_faces, 1u);
  EXPECT_EQ(result.mesh.faces.size(), 6u);
  EXPECT_NEAR(enclosed_volume(result.mesh), 8.0 / 6, 1e-15);
}

// Two corners differ in the last bit: a needle, and a hole of its neighbour at the short edge.
TEST(repair, makes_one_of_corners_that_rounding_keeps_apart) {
  Mesh mesh = tetrahedron();
  for (Vec3& v : mesh.vertices) v += {1, 1, 1};
  mesh.vertices.push_back({1, 1, std::nextafter(1.0, 2.0)});  // beside vertex 0
  mesh.faces = {{0, 2, 1}, {4, 3, 2}, {4, 1, 3}, {1, 2, 3}, {0, 4, 2}, {0, 1, 4}};
  ASSERT_TRUE(inspect(mesh).closed);
  const Repaired result = repair(mesh);
  expect_solid(result.report.after, 1);
  EXPECT_EQ(result.mesh.vertices.size(), 4u);
  EXPECT_EQ(result.report.degenerate_faces, 2u);
}

TEST(repair, closes_small_holes_and_keeps_the_genus) {
  Mesh mesh = torus(1, 0.4, 24, 12);
  const double volume = enclosed_volume(mesh);
  // Two triangles of one square are missing, and one elsewhere.
  mesh.faces.erase(mesh.faces.begin() + 100, mesh.faces.begin() + 102);
  mesh.faces.erase(mesh.faces.begin() + 300);
  const Repaired result = repair(mesh);
  expect_solid(result.report.after, 1);
  EXPECT_EQ(result.report.after.genus, 1u);
  EXPECT_EQ(result.report.closed_holes, 2u);
  EXPECT_EQ(result.report.hole_faces, 3u);
  EXPECT_NEAR(enclosed_volume(result.mesh), volume, 1e-2 * volume);
}

// The torus of seven vertices has an edge between any two of them. Without vertex 6 and its faces,
// no diagonal of the hole is free: the hole is closed around a new vertex.
TEST(repair, closes_a_hole_around_a_new_vertex_where_all_its_corners_are_joined) {
  Mesh mesh{.vertices = {},
            .faces = {},
            .attributes = {{.name = "quality", .values = {}},
                           {.name = "label", .type = ScalarType::kUint8, .values = {}}}};
  for (int i = 0; i < 6; ++i) {
    const double phi = std::numbers::pi / 3 * i;
    mesh.vertices.push_back({std::cos(phi), std::sin(phi), 0.1 * (i % 2)});
    mesh.attributes[0].values.push_back(i + 0.25);
    mesh.attributes[1].values.push_back(i * i);
  }
  for (std::uint32_t i = 0; i < 7; ++i) {
    for (const Triangle& t :
         {Triangle{i, (i + 1) % 7, (i + 3) % 7}, Triangle{i, (i + 3) % 7, (i + 2) % 7}}) {
      if (std::find(t.begin(), t.end(), 6) == t.end()) mesh.faces.push_back(t);
    }
  }
  ASSERT_EQ(inspect(mesh).boundary_edges, 6u);
  const Repaired result = repair(mesh);
  expect_solid(result.report.after, 1);
  EXPECT_EQ(result.report.after.genus, 1u);
  EXPECT_EQ(result.report.closed_holes, 1u);
  EXPECT_EQ(result.report.hole_faces, 6u);
  ASSERT_EQ(result.mesh.vertices.size(), 7u);
  EXPECT_NEAR(norm(result.mesh.vertices[6] - Vec3{0, 0, 0.05}), 0, 1e-15);
  EXPECT_NEAR(result.mesh.attributes[0].values[6], 2.75, 1e-15);
  EXPECT_EQ(result.mesh.attributes[1].values[6], 9);  // 55 / 6 as an integer
}

// One face of the box (two triangles per cell) is missing; flat covers are exact.
TEST(repair, gives_a_box_its_missing_side_back) {
  for (const int cells : {1, 4, 8}) {
    Mesh mesh = box({1, 2, 3}, cells);
    std::erase_if(mesh.faces, [&](const Triangle& t) {
      return std::all_of(t.begin(), t.end(),
                         [&](std::uint32_t v) { return mesh.vertices[v].z > 1.5 - 1e-9; });
    });
    ASSERT_EQ(inspect(mesh).boundary_edges, 4u * cells);
    const Repaired result = repair(mesh);
    expect_solid(result.report.after, 1);
    EXPECT_NEAR(enclosed_volume(result.mesh), 6, 1e-12) << cells;
    EXPECT_NEAR(surface_area(result.mesh), 22, 1e-12) << cells;
  }
}

TEST(repair, leaves_large_holes_and_open_sheets_and_says_so) {
  Mesh half = icosphere(4);
  std::erase_if(half.faces, [&](const Triangle& t) {
    return half.vertices[t[0]].z + half.vertices[t[1]].z + half.vertices[t[2]].z < 0;
  });
  const std::size_t rim = inspect(weld(half).mesh).boundary_edges;
  const Repaired kept = repair(half, {.max_hole = rim - 1});
  EXPECT_EQ(kept.report.large_holes, 1u);
  EXPECT_EQ(kept.report.largest_hole, rim);
  EXPECT_FALSE(kept.report.after.closed);
  // Half a ball with a lid is not a sheet: the ratio is pi / 2 pi.
  expect_solid(repair(half, {.max_hole = rim}).report.after, 1);
  // A square and one triangle: their covers are as large as they are.
  const Mesh square{.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                    .faces = {{0, 1, 2}, {0, 2, 3}},
                    .attributes = {}};
  Mesh triangle = square;
  triangle.faces.pop_back();
  for (const Mesh& sheet : {square, triangle}) {
    const Repaired result = repair(sheet);
    EXPECT_EQ(result.report.sheets, 1u);
    EXPECT_EQ(result.mesh.faces, weld(sheet).mesh.faces);
  }
}

TEST(repair, separates_solids_that_touch_in_an_edge_or_a_corner) {
  const Mesh cube = box({1, 1, 1}, 1);
  for (const Vec3 by : {Vec3{1, 1, 0}, Vec3{1, 1, 1}}) {
    const Mesh touching = weld(joined(cube, shifted(cube, by))).mesh;
    ASSERT_FALSE(inspect(touching).manifold);
    const Repaired result = repair(touching);
    expect_solid(result.report.after, 2);
    EXPECT_EQ(result.report.split_vertices, by.z == 0 ? 2u : 1u);
    EXPECT_NEAR(enclosed_volume(result.mesh), 2, 1e-5);
    // Single precision must not join the vertices again.
    Mesh rounded = result.mesh;
    for (Vec3& v : rounded.vertices) {
      v = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    }
    EXPECT_TRUE(inspect(weld(rounded).mesh).manifold);
  }
}

TEST(repair, takes_a_fin_off_a_solid) {
  Mesh mesh = tetrahedron();
  mesh.vertices.push_back({2, 2, 2});
  mesh.faces.push_back({1, 2, 4});  // three triangles at the edge from 1 to 2
  const Repaired result = repair(mesh);
  EXPECT_EQ(result.report.after.components, 2u);
  EXPECT_EQ(result.report.after.boundary_edges, 3u);
  EXPECT_TRUE(result.report.after.manifold);
  EXPECT_EQ(result.report.sheets, 1u);
}

TEST(repair, of_nested_solids_makes_cavities) {
  // A ball in a shell in a ball, each inside out or not: depths 0, 1, 2.
  const double sizes[] = {3, 2, 1};
  for (int wrong = 0; wrong < 8; ++wrong) {
    Mesh all;
    for (int k = 0; k < 3; ++k) {
      Mesh ball = scaled(icosphere(2), sizes[k]);
      if ((wrong >> k) & 1) flip(ball);
      all = joined(all, ball);
    }
    const Repaired result = repair(all);
    expect_solid(result.report.after, 3);
    EXPECT_EQ(result.report.cavities, 1u);
    const double ball = enclosed_volume(icosphere(2));
    EXPECT_NEAR(enclosed_volume(result.mesh), (27 - 8 + 1) * ball, 1e-12) << wrong;
  }
}

TEST(repair, leaves_a_moebius_strip_one_sided) {
  Mesh strip;
  constexpr std::uint32_t kSteps = 24;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double phi = 2 * std::numbers::pi * i / kSteps;
    for (const double w : {-0.3, 0.3}) {
      const double r = 1 + w * std::cos(phi / 2);
      strip.vertices.push_back({r * std::cos(phi), r * std::sin(phi), w * std::sin(phi / 2)});
    }
    const std::uint32_t a = 2 * i, b = a + 1;
    const bool last = i + 1 == kSteps;
    const std::uint32_t c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.faces.push_back({a, c, b});
    strip.faces.push_back({b, c, d});
  }
  const Repaired result = repair(strip);
  EXPECT_EQ(result.report.one_sided_parts, 1u);
  EXPECT_EQ(result.mesh.faces, strip.faces);
}

TEST(repair, does_not_depend_on_size_or_place) {
  Mesh mesh = icosphere(2);
  mesh.faces.erase(mesh.faces.begin() + 5);
  std::swap(mesh.faces[9][0], mesh.faces[9][1]);
  const Repaired expected = repair(mesh);
  for (const double size : {0x1p-332, 0x1p332, 0x1p1000, 0x1p-990}) {
    const Repaired result = repair(scaled(mesh, size));
    EXPECT_EQ(result.mesh.faces, expected.mesh.faces) << size;
    EXPECT_EQ(result.mesh.vertices, scaled(expected.mesh, size).vertices) << size;
  }
}

TEST(repair, carries_attributes_and_turns_normals_with_their_faces) {
  Mesh mesh = icosphere(2);
  mesh.attributes = {{.name = "nx", .values = {}},
                     {.name = "ny", .values = {}},
                     {.name = "nz", .values = {}},
                     {.name = "quality", .values = {}}};
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3& n = mesh.vertices[v];
    mesh.attributes[0].values.push_back(n.x), mesh.attributes[1].values.push_back(n.y);
    mesh.attributes[2].values.push_back(n.z), mesh.attributes[3].values.push_back(double(v));
  }
  Mesh wrong = mesh;
  flip(wrong);
  const Repaired result = repair(wrong);
  EXPECT_EQ(result.report.inside_out_parts, 1u);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(result.mesh.attributes[k].values, mesh.attributes[k].values) << k;
  }
}

TEST(repair, refuses_holes_that_cost_too_much) {
  EXPECT_THROW(repair(icosphere(1), {.max_hole = 501}), Error);
  EXPECT_THROW(repair(icosphere(1), {.weld = -1}), Error);
  EXPECT_NO_THROW(repair(Mesh{}));
}

// n points on a circle give n - 2 triangles with the area of the polygon, for any diagonals.
TEST(triangulate_hole, of_a_convex_polygon_has_its_area) {
  for (const std::uint32_t n : {3u, 4u, 7u, 40u}) {
    std::vector<Vec3> rim;
    for (std::uint32_t i = 0; i < n; ++i) {
      const double phi = 2 * std::numbers::pi * i / n;
      rim.push_back({std::cos(phi), std::sin(phi), 0});
    }
    const std::vector<Vec3> beyond(n, Vec3{0, 0, 1});
    const auto free = [](std::uint32_t, std::uint32_t) { return false; };
    const auto hole = triangulate_hole(rim, beyond, free);
    ASSERT_TRUE(hole);
    EXPECT_EQ(hole->faces.size(), n - 2);
    EXPECT_NEAR(hole->area, n * std::sin(2 * std::numbers::pi / n) / 2, 1e-13);
    const auto taken = [](std::uint32_t, std::uint32_t) { return true; };
    EXPECT_EQ(triangulate_hole(rim, beyond, taken).has_value(), n == 3);
  }
}

// An L-shaped polygon: a diagonal across the notch would add area.
TEST(triangulate_hole, of_a_polygon_with_a_notch_stays_inside) {
  const std::vector<Vec3> rim = {{0, 0, 0}, {4, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}};
  const std::vector<Vec3> beyond(rim.size(), Vec3{0, 0, 1});
  const auto hole =
      triangulate_hole(rim, beyond, [](std::uint32_t, std::uint32_t) { return false; });
  ASSERT_TRUE(hole);
  EXPECT_NEAR(hole->area, 7, 1e-14);
}

// Returns true if free diagonals can triangulate the polygon from i to j.
bool can_close(std::uint32_t i, std::uint32_t j, std::uint32_t n,
               const std::set<std::pair<std::uint32_t, std::uint32_t>>& taken) {
  if (j == i + 1) return true;
  if (j - i + 1 < n && taken.contains({i, j})) return false;
  for (std::uint32_t m = i + 1; m < j; ++m) {
    if (can_close(i, m, n, taken) && can_close(m, j, n, taken)) return true;
  }
  return false;
}

// Polygons whose triangles mostly have no area, with some diagonals taken.
TEST(triangulate_hole, of_straight_sides_keeps_off_taken_diagonals) {
  int closed = 0, open = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const auto n = static_cast<std::uint32_t>(4 + seed % 5);
    std::vector<Vec3> rim;
    std::set<std::pair<std::uint32_t, std::uint32_t>> taken;
    for (std::uint32_t i = 0; i < n; ++i) {
      rim.push_back(
          {1.0 * static_cast<double>(random_bits(seed, i) % 3), seed % 2 == 0 ? 0.0 : i, 0});
      for (std::uint32_t j = i + 2; j < n; ++j) {
        if (random_bits(seed + 1000, n * i + j) % 2 == 0) taken.insert({i, j});
      }
    }
    const std::vector<Vec3> beyond(n, Vec3{});
    const auto hole = triangulate_hole(rim, beyond, [&](std::uint32_t i, std::uint32_t j) {
      return taken.contains({i, j});
    });
    ASSERT_EQ(hole.has_value(), can_close(0, n - 1, n, taken)) << seed;
    ++(hole ? closed : open);
    if (!hole) continue;
    EXPECT_EQ(hole->faces.size(), n - 2);
    for (const auto& [i, m, j] : hole->faces) {
      EXPECT_TRUE(i < m && m < j) << seed;
      for (const auto& diagonal : {std::pair{i, m}, std::pair{m, j}}) {
        EXPECT_FALSE(taken.contains(diagonal)) << seed;
      }
    }
  }
  EXPECT_GT(closed, 100);
  EXPECT_GT(open, 100);
}

// Splits the edge from a to b of a triangle at new vertices, given as parts of the edge.
void split_edge(std::uint32_t triangle, std::uint32_t a, std::uint32_t b,
                const std::vector<double>& shares, Mesh& mesh) {
  const Vec3 begin = mesh.vertices[a], way = mesh.vertices[b] - begin;
  for (const double share : shares) {
    const auto at = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(begin + share * way);
    Triangle near = mesh.faces[triangle];
    std::ranges::replace(near, b, at);
    std::ranges::replace(mesh.faces[triangle], a, at);
    mesh.faces.push_back(near);
    a = at;
  }
}

// A box with edges that are split on one side only, or at different places on both sides.
TEST(repair, joins_vertices_on_edges_of_other_faces) {
  const std::vector<std::pair<std::vector<double>, std::vector<double>>> cases = {
      {{0.5}, {}},
      {{0.2, 0.3, 0.9}, {}},
      {{0.4}, {0.7}},
      {{0.1, 0.5, 0.6}, {0.3, 0.55, 0.8}},
  };
  for (const auto& [left, right] : cases) {
    SCOPED_TRACE(left.size() + 10 * right.size());
    Mesh mesh = box({2, 3, 4}, 1);
    const std::vector<Edge> edges = pair_edges(mesh);
    const Edge edge = edges.front();
    split_edge(edge.left, edge.a, edge.b, left, mesh);
    split_edge(edge.right, edge.a, edge.b, right, mesh);
    const Repaired result = repair(mesh);
    EXPECT_EQ(result.report.junctions, left.size() + right.size());
    EXPECT_EQ(result.report.closed_holes, 0u);
    EXPECT_EQ(result.report.split_vertices, 0u);
    expect_solid(result.report.after, 1);
    EXPECT_NEAR(result.report.after.volume, 24, 1e-12);
    const Repaired again = repair(result.mesh);
    EXPECT_TRUE(again.mesh.vertices == result.mesh.vertices);
    EXPECT_TRUE(again.mesh.faces == result.mesh.faces);
    EXPECT_EQ(again.report.junctions, 0u);
  }
}

// A face without width closes the gap of a junction, beside an edge that then has three faces.
TEST(repair, drops_a_thin_face_beside_an_edge_of_three) {
  Mesh mesh = box({2, 2, 2}, 1);
  const Edge edge = pair_edges(mesh).front();
  const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.push_back(0.5 * (mesh.vertices[edge.a] + mesh.vertices[edge.b]));
  mesh.faces.push_back({edge.a, middle, edge.b});
  const Repaired result = repair(mesh);
  EXPECT_EQ(result.report.degenerate_faces, 1u);
  EXPECT_EQ(result.report.split_vertices, 0u);
  expect_solid(result.report.after, 1);
  EXPECT_NEAR(result.report.after.volume, 8, 1e-12);
  EXPECT_EQ(result.mesh.faces.size(), 12u);
}

// Open edges in one direction from a vertex stay if they are farther apart than the rounding.
TEST(repair, leaves_slits_that_are_wider_than_rounding) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {1, -1e-3, 0}, {0.5, -1, 0}};
  mesh.faces = {{0, 1, 2}, {0, 4, 3}};
  const Repaired result = repair(mesh);
  EXPECT_EQ(result.report.junctions, 0u);
  EXPECT_EQ(result.mesh.faces.size(), 2u);
}

}  // namespace
}  // namespace rholm
