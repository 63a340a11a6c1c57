#include "rholm/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "rholm/context.h"
#include "rholm/error.h"
#include "rholm/primitives.h"
#include "support/random_data.h"
#include "support/test_meshes.h"

namespace rholm {
namespace {

using test::joined;
using test::moved;
using test::tetrahedron;

bool has_half_edge(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

void expect_edges_right(const Mesh& mesh, const std::vector<Edge>& edges) {
  EXPECT_EQ(2 * edges.size(), 3 * mesh.faces.size());
  std::pair<std::uint32_t, std::uint32_t> last{0, 0};
  for (const Edge& e : edges) {
    EXPECT_TRUE(has_half_edge(mesh.faces[e.left], e.a, e.b));
    EXPECT_TRUE(has_half_edge(mesh.faces[e.right], e.b, e.a));
    const auto key = std::minmax(e.a, e.b);
    EXPECT_LE(last, (std::pair{key.first, key.second}));
    last = {key.first, key.second};
  }
}

// Loops over a whole mesh can be cancelled, also in functions without a Context.
TEST(inspect, ends_where_the_scope_of_the_thread_says_so) {
  const Mesh mesh = icosphere(6);
  const auto expect_cancelled = [](const auto& run) {
    const CancelScope scope([] { return false; });
    try {
      run();
      ADD_FAILURE() << "not cancelled";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kCancelled);
    }
  };
  expect_cancelled([&] { inspect(mesh); });
  expect_cancelled([&] { weld(mesh); });
  expect_cancelled([&] { pair_edges(mesh); });
  expect_cancelled([&] { closing_tolerance(mesh); });
  expect_cancelled([&] { enclosed_volume(mesh); });
  EXPECT_TRUE(inspect(mesh).closed);
}

TEST(pair_edges, names_both_triangles_of_every_edge_in_the_order_of_vertices) {
  for (const Mesh& mesh : {tetrahedron(), icosphere(3), torus(2, 1, 7, 5), box({1, 2, 3}, 4),
                           latitude_longitude_sphere(2, 1000)}) {  // poles of 1000 triangles
    expect_edges_right(mesh, pair_edges(mesh));
  }
}

TEST(pair_edges, pairs_opposite_sides_in_file_order_where_four_triangles_meet) {
  Mesh mesh =
      joined(tetrahedron(), moved(tetrahedron(), test::rotation({0, 0, 1}, std::numbers::pi)));
  // Both bodies stand on the z axis: edge 0-3.
  for (Triangle& t : mesh.faces) {
    for (std::uint32_t& v : t) {
      if (v == 4) v = 0;
      if (v == 7) v = 3;
    }
  }
  const std::vector<Edge> edges = pair_edges(mesh);
  expect_edges_right(mesh, edges);
  std::vector<Edge> shared;
  for (const Edge& e : edges) {
    if (std::minmax(e.a, e.b) == std::minmax(0u, 3u)) shared.push_back(e);
  }
  ASSERT_EQ(shared.size(), 2u);
  EXPECT_LT(shared[0].left, shared[1].left);
  EXPECT_LT(shared[0].right, shared[1].right);
}

std::string refusal(const Mesh& mesh) {
  try {
    pair_edges(mesh);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
    return error.what();
  }
  return "accepted";
}

TEST(pair_edges, refuses_open_misoriented_and_odd_edges_with_their_number) {
  Mesh open = tetrahedron();
  open.faces.pop_back();
  EXPECT_NE(refusal(open).find("3 boundary edges"), std::string::npos) << refusal(open);
  Mesh flipped = tetrahedron();
  std::swap(flipped.faces[0][0], flipped.faces[0][1]);
  EXPECT_NE(refusal(flipped).find("3 between faces of opposite"), std::string::npos);
  Mesh odd = tetrahedron();
  odd.vertices.push_back({2, 2, 2});
  odd.faces.push_back({0, 1, 4});
  EXPECT_NE(refusal(odd).find("2 boundary edges"), std::string::npos);
  EXPECT_NE(refusal(odd).find("1 where three or more"), std::string::npos);
  EXPECT_TRUE(pair_edges(Mesh{}).empty());
}

TEST(pair_edges, passes_over_triangles_with_a_repeated_corner) {
  Mesh mesh = tetrahedron();
  mesh.faces.insert(mesh.faces.begin() + 1, {{1, 1, 2}});
  const std::vector<Edge> edges = pair_edges(mesh);
  EXPECT_EQ(edges.size(), 6u);
  for (const Edge& e : edges) EXPECT_TRUE(e.left != 1 && e.right != 1);
}

TEST(inspect, euler_characteristic_is_2_minus_2_genus_per_component) {
  EXPECT_EQ(inspect(icosphere(2)).euler_characteristic, 2);
  const Inspection ring = inspect(torus(3, 1, 8, 6));
  EXPECT_EQ(ring.euler_characteristic, 0);
  EXPECT_EQ(ring.genus, 1u);
  const Inspection two = inspect(joined(torus(3, 1, 8, 6), torus(30, 1, 5, 6)));
  EXPECT_EQ(two.components, 2u);
  EXPECT_EQ(two.genus, 2u);
  EXPECT_EQ(inspect(joined(icosphere(1), icosphere(2))).euler_characteristic, 4);
  EXPECT_EQ(inspect(joined(icosphere(1), icosphere(2))).genus, 0u);
}

TEST(inspect, volume_area_and_centroids_of_a_tetrahedron_are_those_of_the_books) {
  const Inspection shape = inspect(tetrahedron());
  EXPECT_NEAR(shape.volume, 1.0 / 6, 1e-16);
  EXPECT_NEAR(shape.area, 1.5 + std::sqrt(3) / 2, 1e-15);
  EXPECT_NEAR(norm(shape.volume_centroid - Vec3{0.25, 0.25, 0.25}), 0, 1e-15);
  EXPECT_NEAR(norm(shape.vertex_centroid - Vec3{0.25, 0.25, 0.25}), 0, 1e-15);
  EXPECT_EQ(shape.bounds.min, (Vec3{0, 0, 0}));
  EXPECT_EQ(shape.bounds.max, (Vec3{1, 1, 1}));
}

// A shift by 1e6 sizes costs 1e6 2^-53 in coordinates, and at most a few times that in the
// results.
TEST(inspect, measures_stay_accurate_far_from_the_origin) {
  const Inspection near = inspect(icosphere(3));
  const Inspection far = inspect(moved(icosphere(3), {.shift = {1e6, -2e6, 3e6}}));
  EXPECT_NEAR(far.volume, near.volume, 1e-9);
  EXPECT_NEAR(far.area, near.area, 1e-9);
  EXPECT_NEAR(norm(far.volume_centroid - Vec3{1e6, -2e6, 3e6}), 0, 1e-9);
}

TEST(inspect, measures_scale_with_the_shape) {
  const Inspection one = inspect(tetrahedron());
  for (const double scale : {1e-100, 1e-30, 1e30, 1e100}) {
    const Inspection shape = inspect(moved(tetrahedron(), {.scale = scale, .shift = {}}));
    EXPECT_EQ(shape.degenerate_faces, 0u);
    EXPECT_NEAR(shape.volume / scale / scale / scale, one.volume, 1e-15);
    EXPECT_NEAR(shape.area / scale / scale, one.area, 1e-14);
    EXPECT_NEAR(shape.volume_centroid.x / scale, 0.25, 1e-15);
  }
  for (const double scale : {1e-300, 1e300}) {  // volume and area exceed the range of double
    const Inspection shape = inspect(moved(tetrahedron(), {.scale = scale, .shift = {}}));
    EXPECT_EQ(shape.degenerate_faces, 0u);
    EXPECT_NEAR(shape.volume_centroid.x / scale, 0.25, 1e-15);
    EXPECT_FALSE(std::isnan(shape.volume) || std::isnan(shape.area));
  }
}

// Faces of the tetrahedron at the origin have the normals (0, 0, -1), (-1, 0, 0), (0, -1, 0) and
// (1, 1, 1), each as long as twice its area.
TEST(area_normals, are_sums_of_normals_as_long_as_twice_the_areas) {
  Mesh mesh = tetrahedron();
  mesh.vertices.push_back({7, 7, 7});  // belongs to no triangle
  const std::vector<Vec3> normals = area_normals(mesh.vertices, mesh.faces);
  EXPECT_EQ(normals, (std::vector<Vec3>{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}));
  for (Vec3& v : mesh.vertices) v = 2 * v;  // powers of two are exact
  EXPECT_EQ(area_normals(mesh.vertices, mesh.faces)[1], (Vec3{4, 0, 0}));
  flip(mesh);
  EXPECT_EQ(area_normals(mesh.vertices, mesh.faces)[2], (Vec3{0, -4, 0}));
  EXPECT_TRUE(area_normals({}, {}).empty());
}

TEST(inspect, finds_the_shape_turned_inside_out_and_flip_turns_it_back) {
  Mesh mesh = icosphere(1);
  mesh.attributes = {{.name = "nx", .values = std::vector<double>(42, 0.5)},
                     {.name = "red", .values = std::vector<double>(42, 0.5)}};
  flip(mesh);
  EXPECT_TRUE(inspect(mesh).inside_out);
  EXPECT_LT(enclosed_volume(mesh), 0);
  EXPECT_EQ(mesh.attributes[0].values[0], -0.5);
  EXPECT_EQ(mesh.attributes[1].values[0], 0.5);
  flip(mesh);
  EXPECT_FALSE(inspect(mesh).inside_out);
}

TEST(inspect, counts_boundary_and_misoriented_edges) {
  Mesh open = icosphere(1);
  open.faces.pop_back();
  EXPECT_EQ(inspect(open).boundary_edges, 3u);
  EXPECT_FALSE(inspect(open).closed);
  EXPECT_TRUE(inspect(open).manifold);
  Mesh turned = icosphere(1);
  std::swap(turned.faces[5][0], turned.faces[5][1]);
  EXPECT_EQ(inspect(turned).misoriented_edges, 3u);
  EXPECT_TRUE(inspect(turned).closed);
  EXPECT_FALSE(inspect(turned).oriented);
}

// A strip of n squares, with the last joined to the first upside down.
TEST(inspect, a_moebius_strip_has_one_boundary_no_orientation_and_characteristic_zero) {
  constexpr std::uint32_t n = 8;
  Mesh strip;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n;
    for (const double s : {-0.3, 0.3}) {
      const double rho = 1 + s * std::cos(a / 2);
      strip.vertices.push_back({rho * std::cos(a), rho * std::sin(a), s * std::sin(a / 2)});
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t a = 2 * i, b = a + 1;
    const std::uint32_t c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? a + 3 : 0;
    strip.faces.push_back({a, c, d});
    strip.faces.push_back({a, d, b});
  }
  const Inspection shape = inspect(strip);
  EXPECT_EQ(shape.boundary_edges, 2 * n);
  EXPECT_EQ(shape.misoriented_edges, 1u);
  EXPECT_EQ(shape.euler_characteristic, 0);
  EXPECT_TRUE(shape.manifold);
  EXPECT_FALSE(shape.oriented);
  EXPECT_EQ(shape.components, 1u);
}

TEST(inspect, two_tetrahedra_in_one_corner_are_not_a_manifold_there) {
  Mesh bow_tie = joined(tetrahedron(), moved(tetrahedron(), {.scale = -1, .shift = {}}));
  for (std::size_t t = 4; t < 8; ++t) {
    std::swap(bow_tie.faces[t][0], bow_tie.faces[t][1]);
    for (std::uint32_t& v : bow_tie.faces[t]) v = v == 4 ? 0 : v;
  }
  const Inspection shape = inspect(bow_tie);
  EXPECT_TRUE(shape.closed);
  EXPECT_EQ(shape.non_manifold_vertices, 1u);
  EXPECT_EQ(shape.non_manifold_edges, 0u);
  EXPECT_FALSE(shape.manifold);
  EXPECT_EQ(shape.components, 2u);  // edges connect, vertices do not
  EXPECT_EQ(shape.isolated_vertices, 1u);
}

TEST(inspect, three_triangles_in_one_edge_are_not_a_manifold) {
  const Mesh book{.vertices = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}},
                  .faces = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}},
                  .attributes = {}};
  const Inspection shape = inspect(book);
  EXPECT_EQ(shape.non_manifold_edges, 1u);
  EXPECT_EQ(shape.boundary_edges, 6u);
  EXPECT_EQ(shape.non_manifold_vertices, 2u);
  EXPECT_EQ(shape.misoriented_edges, 0u);
}

TEST(inspect, counts_triangles_given_twice_in_any_order_of_corners) {
  Mesh mesh = icosphere(1);
  const Triangle t = mesh.faces[7], s = mesh.faces[20];
  mesh.faces.push_back({t[1], t[2], t[0]});
  mesh.faces.push_back({s[1], s[0], s[2]});
  mesh.faces.push_back({s[2], s[0], s[1]});
  EXPECT_EQ(inspect(mesh).duplicate_faces, 3u);
  EXPECT_EQ(inspect(icosphere(2)).duplicate_faces, 0u);
}

TEST(inspect, degenerate_triangles_are_those_flat_within_rounding) {
  const auto count = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return inspect({.vertices = {a, b, c}, .faces = {{0, 1, 2}}, .attributes = {}})
        .degenerate_faces;
  };
  EXPECT_EQ(count({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), 1u);
  EXPECT_EQ(count({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.3, 0.3, 0.3}), 1u);  // decimals are rounded
  EXPECT_EQ(count({1, 2, 3}, {1, 2, 3}, {4, 4, 4}), 1u);
  EXPECT_EQ(count({1, 2, 3}, {1, 2, 3}, {1, 2, 3}), 1u);
  // The triangle is thin, but thicker than the rounding of its coordinates.
  EXPECT_EQ(count({0, 0, 0}, {1, 1e-12, 0}, {2, 0, 0}), 0u);
  EXPECT_EQ(count({0, 0, 0}, {1e-14, 0, 0}, {0, 1, 0}), 0u);
  EXPECT_EQ(count({0, 0, 0}, {1e-200, 0, 0}, {0, 1, 0}), 1u);
  // At a distance of 1e5 this thickness is rounding: an ulp there is 1.5e-11.
  EXPECT_EQ(count({1e5, 1e5, 0}, {1e5 + 1, 1e5 + 1e-12, 0}, {1e5 + 2, 1e5, 0}), 1u);
  const Mesh repeated{.vertices = {{0, 0, 0}, {1, 0, 0}}, .faces = {{0, 0, 1}}, .attributes = {}};
  EXPECT_EQ(inspect(repeated).degenerate_faces, 1u);
  EXPECT_FALSE(inspect(repeated).closed);
}

TEST(inspect, answers_for_the_smallest_and_refuses_the_worst_meshes) {
  const Inspection empty = inspect({});
  EXPECT_FALSE(empty.closed);
  EXPECT_EQ(empty.volume, 0);
  const Mesh one{.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}},
                 .faces = {{0, 1, 2}},
                 .attributes = {}};
  const Inspection shape = inspect(one);
  EXPECT_EQ(shape.boundary_edges, 3u);
  EXPECT_EQ(shape.isolated_vertices, 1u);
  EXPECT_DOUBLE_EQ(shape.area, 0.5);
  EXPECT_EQ(shape.components, 1u);
  Mesh bad = tetrahedron();
  bad.vertices[1].z = std::numeric_limits<double>::infinity();
  EXPECT_THROW(inspect(bad), Error);
  bad = tetrahedron();
  bad.faces[2][1] = 4;
  EXPECT_THROW(inspect(bad), Error);
  EXPECT_THROW(pair_edges(bad), Error);
}

TEST(validate, refuses_lists_that_are_not_as_long_as_that_of_points) {
  Mesh mesh = tetrahedron();
  mesh.attributes = {{.name = "quality", .values = {1, 2, 3}}};
  EXPECT_THROW(validate(mesh), Error);
  mesh.attributes[0].values.push_back(4);
  EXPECT_NO_THROW(validate(mesh));
  PointCloud cloud{.points = mesh.vertices, .normals = {{0, 0, 1}}, .attributes = mesh.attributes};
  EXPECT_THROW(validate(cloud), Error);
  cloud.normals.assign(4, {0, 0, 1});
  EXPECT_NO_THROW(validate(cloud));
  cloud.attributes[0].values.push_back(5);
  EXPECT_THROW(validate(cloud), Error);
}

TEST(bounds, of_no_points_are_zero_and_of_the_largest_numbers_finite_inspections) {
  EXPECT_EQ(bounds({}).max, (Vec3{0, 0, 0}));
  const double huge = std::numeric_limits<double>::max();
  const Inspection shape =
      inspect(moved(tetrahedron(), {.scale = huge, .shift = {-huge / 2, -huge / 2, -huge / 2}}));
  EXPECT_FALSE(std::isnan(shape.volume) || std::isnan(shape.area));
  EXPECT_FALSE(std::isnan(shape.volume_centroid.x));
}

}  // namespace
}  // namespace rholm
