#include "rholm/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <set>
#include <string_view>
#include <vector>

#include "rholm/error.h"
#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "shape/simplify/simplify_part.h"
#include "shape/topology/vertex_stars.h"
#include "support/random_data.h"
#include "support/test_meshes.h"

namespace rholm {
namespace {

using test::joined;
using test::moved;
using test::tetrahedron;

// Returns the unit square as n x n cells of two triangles.
Mesh square(int n) {
  Mesh mesh;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      mesh.vertices.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n, 0});
    }
  }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

Inspection expect_closed_manifold(const Mesh& mesh, long long euler) {
  const Inspection found = inspect(mesh);
  EXPECT_TRUE(found.closed && found.manifold && found.oriented);
  EXPECT_EQ(found.duplicate_faces, 0U);
  EXPECT_EQ(found.isolated_vertices, 0U);
  EXPECT_EQ(found.euler_characteristic, euler);
  return found;
}

ErrorCode code_of(const std::function<void()>& run) {
  try {
    run();
  } catch (const Error& error) {
    return error.code();
  }
  return {};
}

TEST(simplify, a_box_of_many_cells_becomes_twelve_triangles_without_error) {
  const Simplification simple = simplify(box({1, 2, 3}, 16), {.faces = 12});
  const Inspection found = expect_closed_manifold(simple.mesh, 2);
  EXPECT_EQ(found.faces, 12U);
  EXPECT_NEAR(found.volume, 6, 1e-12);
  EXPECT_NEAR(found.area, 22, 1e-12);
  EXPECT_LT(simple.error, 1e-6);
}

TEST(simplify, an_error_of_zero_takes_what_is_flat_and_no_more) {
  const Simplification simple = simplify(box({1, 1, 1}, 8), {.max_error = 1e-6});
  EXPECT_EQ(simple.mesh.faces.size(), 12U);
  EXPECT_EQ(simplify(icosphere(2), {.max_error = 1e-6}).mesh.faces, icosphere(2).faces);
}

TEST(simplify, a_square_becomes_two_triangles_within_its_border) {
  const Simplification simple = simplify(square(24), {.faces = 2});
  EXPECT_EQ(simple.mesh.faces.size(), 2U);
  EXPECT_NEAR(surface_area(simple.mesh), 1, 1e-12);
  const Inspection found = inspect(simple.mesh);
  EXPECT_TRUE(found.manifold && found.oriented);
  EXPECT_EQ(found.boundary_edges, 4U);
}

TEST(simplify, topology_stays_down_to_the_smallest_meshes_there_are) {
  // A closed surface has at least 4 triangles, as a tetrahedron; a torus 14, as Csaszar's
  // polyhedron.
  const Mesh sphere = simplify(icosphere(3), {.faces = 1}).mesh;
  EXPECT_EQ(expect_closed_manifold(sphere, 2).faces, 4U);
  const Mesh ring = simplify(torus(1, 0.3, 48, 24), {.faces = 1}).mesh;
  EXPECT_GE(expect_closed_manifold(ring, 0).faces, 14U);
  EXPECT_LE(ring.faces.size(), 60U);  // the turn of normals is limited as well
  const Mesh two = simplify(joined(icosphere(2), torus(5, 1, 40, 20)), {.faces = 1}).mesh;
  EXPECT_EQ(expect_closed_manifold(two, 2).components, 2U);
}

TEST(simplify, vertices_stay_on_a_sphere_and_triangles_near_it) {
  for (const std::size_t wanted : {8000U, 2000U, 500U}) {
    const Simplification simple = simplify(icosphere(5), {.faces = wanted});
    const Inspection found = expect_closed_manifold(simple.mesh, 2);
    EXPECT_LE(found.faces, wanted);
    EXPECT_GE(found.faces, wanted - 2);
    for (const Vec3& v : simple.mesh.vertices) EXPECT_NEAR(norm(v), 1, 1e-12);
    // Equilateral triangles would lose the least volume of the ball. With edges a there are 4 pi /
    // (sqrt(3)/4 a^2) of them, and the mean gap over one is (a^2/3 - a^2/12) / 2.
    const double least = 2 * std::numbers::pi * std::sqrt(3.0) / static_cast<double>(wanted);
    const double missing = 1 - found.volume / (4 * std::numbers::pi / 3);
    EXPECT_GT(missing, 0.98 * least);
    EXPECT_LT(missing, 1.6 * least);  // measured 1.1 ... 1.55
  }
}

TEST(simplify, the_error_allowed_is_kept_and_used) {
  const Mesh mesh = bumpy_sphere(5, 0.2, 3);
  std::size_t last = mesh.faces.size() + 1;
  for (const double allowed : {1e-4, 1e-3, 1e-2}) {
    const Simplification simple = simplify(mesh, {.max_error = allowed});
    EXPECT_LE(simple.error, allowed * (1 + 1e-5));
    EXPECT_GT(simple.error, allowed / 3);
    EXPECT_LT(simple.mesh.faces.size(), last);
    last = simple.mesh.faces.size();
  }
}

TEST(simplify, edges_of_more_triangles_and_touching_fans_stay) {
  // Two boxes with a common edge, and two with a common corner.
  const auto shift = [](double x, double y, double z) {
    test::Motion motion;
    motion.shift = {x, y, z};
    return motion;
  };
  const Mesh cube = box({1, 1, 1}, 4);
  for (const double z : {0.0, 1.0}) {
    const Mesh both = weld(joined(cube, moved(cube, shift(1, 1, z)))).mesh;
    const Inspection before = inspect(both);
    const Mesh simple = simplify(both, {.max_error = 1e-6}).mesh;
    const Inspection after = inspect(simple);
    EXPECT_EQ(after.non_manifold_edges, before.non_manifold_edges);
    EXPECT_EQ(after.non_manifold_vertices, before.non_manifold_vertices);
    EXPECT_EQ(after.boundary_edges, 0U);
    EXPECT_EQ(after.duplicate_faces, 0U);
    EXPECT_NEAR(after.volume, 2, 1e-12);
    EXPECT_LT(after.faces, before.faces / 2);
  }
}

// Returns closed, open and torn surfaces with vertices and edges that touch.
Mesh random_complex(std::uint64_t seed) {
  std::uint64_t next = 0;
  const auto below = [&](std::size_t n) {
    return static_cast<std::uint32_t>(test::random_in(0, 1, seed, next++) * static_cast<double>(n) *
                                      (1 - 1e-12));
  };
  Mesh mesh = seed % 3 == 0 ? Mesh{} : seed % 3 == 1 ? icosphere(1) : torus(1, 0.4, 6, 5);
  if (seed % 3 == 0) {
    for (std::uint64_t v = 0; v < 10; ++v) mesh.vertices.push_back(test::random_direction(seed, v));
    for (int t = 0; t < 16; ++t) mesh.faces.push_back({below(10), below(10), below(10)});
  } else {
    for (std::uint32_t n = below(6); n > 0; --n) {
      mesh.faces.erase(mesh.faces.begin() + below(mesh.faces.size()));
    }
    const std::uint32_t a = below(mesh.vertices.size()), b = below(mesh.vertices.size());
    for (Triangle& t : mesh.faces) std::replace(t.begin(), t.end(), a, b);
  }
  std::set<Triangle> seen;  // rejects repeated corners and repeated triangles
  std::erase_if(mesh.faces, [&](Triangle t) {
    std::sort(t.begin(), t.end());
    return t[0] == t[1] || t[1] == t[2] || !seen.insert(t).second;
  });
  return mesh;
}

TEST(simplify, connectivity_stays_whatever_the_mesh) {
  // Collapsing an edge under the link condition preserves the homotopy type.
  std::size_t shrunk = 0;
  for (std::uint64_t seed = 1; seed <= 3000; ++seed) {
    const Mesh mesh = random_complex(seed);
    const Inspection before = inspect(mesh);
    const Inspection after = inspect(simplify(mesh, {.faces = 1}, {.threads = 1}).mesh);
    ASSERT_EQ(after.euler_characteristic, before.euler_characteristic) << seed;
    ASSERT_EQ(after.components, before.components) << seed;
    ASSERT_EQ(after.boundary_edges == 0, before.boundary_edges == 0) << seed;
    ASSERT_LE(after.non_manifold_edges, before.non_manifold_edges) << seed;
    ASSERT_LE(after.non_manifold_vertices, before.non_manifold_vertices) << seed;
    ASSERT_LE(after.misoriented_edges, before.misoriented_edges) << seed;
    ASSERT_EQ(after.duplicate_faces, 0U) << seed;
    shrunk += after.faces < before.faces ? 1 : 0;
  }
  EXPECT_GT(shrunk, 1500U);
}

TEST(simplify, units_do_not_matter) {
  const Mesh mesh = bumpy_sphere(4, 0.3, 5);
  const Mesh simple = simplify(mesh, {.share = 0.2}).mesh;
  for (const int power : {-60, -20, 20, 60}) {
    Mesh scaled = mesh;
    for (Vec3& v : scaled.vertices) v *= std::ldexp(1.0, power);
    EXPECT_EQ(simplify(scaled, {.share = 0.2}).mesh.faces, simple.faces) << power;
  }
}

TEST(simplify, attributes_are_those_of_the_vertices_that_stay) {
  Mesh mesh = icosphere(4);
  Attribute height{.name = "height", .type = ScalarType::kFloat64, .values = {}};
  for (const Vec3& v : mesh.vertices) height.values.push_back(v.z);
  mesh.attributes = {height};
  const Mesh simple = simplify(mesh, {.share = 0.1}).mesh;
  ASSERT_EQ(simple.attributes.size(), 1U);
  ASSERT_EQ(simple.attributes[0].values.size(), simple.vertices.size());
  for (std::size_t v = 0; v < simple.vertices.size(); ++v) {
    EXPECT_EQ(simple.attributes[0].values[v], simple.vertices[v].z);
  }
}

TEST(simplify, is_the_same_for_every_number_of_threads) {
  const Mesh mesh = bumpy_sphere(5, 0.3, 7);
  const Mesh one = simplify(mesh, {.share = 0.1}, {.threads = 1}).mesh;
  const Mesh two = simplify(mesh, {.share = 0.1}, {.threads = 2}).mesh;
  EXPECT_EQ(one.vertices, two.vertices);
  EXPECT_EQ(one.faces, two.faces);
}

TEST(simplify, what_is_small_or_degenerate_comes_back) {
  EXPECT_TRUE(simplify(Mesh{}, {.faces = 1}).mesh.faces.empty());
  Mesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
  one.faces = {{0, 1, 2}, {1, 1, 2}};
  const Mesh same = simplify(one, {.share = 1e-9}).mesh;
  EXPECT_EQ(same.faces, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(same.vertices.size(), 3U);
  Mesh point = icosphere(1);
  for (Vec3& v : point.vertices) v = {1, 2, 3};
  EXPECT_NO_THROW(simplify(point, {.faces = 1}));
  EXPECT_EQ(simplify(tetrahedron(), {.faces = 1}).mesh.faces, tetrahedron().faces);
}

TEST(simplify, options_out_of_range_are_refused) {
  const Mesh mesh = icosphere(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const SimplifyOptions& options :
       {SimplifyOptions{}, SimplifyOptions{.share = -0.1}, SimplifyOptions{.share = 1.1},
        SimplifyOptions{.share = nan}, SimplifyOptions{.max_error = -1},
        SimplifyOptions{.max_error = nan}}) {
    EXPECT_EQ(code_of([&] { simplify(mesh, options); }), ErrorCode::kInvalidInput);
  }
}

// Each half of a sphere is simplified with its common vertices locked; then all, with the known
// errors.
TEST(simplify, parts_fit_together_and_go_on_together) {
  const Mesh mesh = icosphere(5);
  std::vector<std::uint8_t> sides(mesh.vertices.size(), 0);
  const auto side_of = [&](const Triangle& t) {
    const double z = mesh.vertices[t[0]].z + mesh.vertices[t[1]].z + mesh.vertices[t[2]].z;
    return std::size_t{z > 0 ? 1U : 0U};
  };
  for (const Triangle& t : mesh.faces) {
    for (const std::uint32_t v : t)
      sides[v] = static_cast<std::uint8_t>(sides[v] | 1U << side_of(t));
  }
  SimplifyPart all{.points = mesh.vertices, .unit = 0.05};
  all.kinds.assign(mesh.vertices.size(), PartVertex::kFree);
  all.quadrics.resize(mesh.vertices.size());
  std::size_t n_locked = 0;
  for (std::size_t v = 0; v < sides.size(); ++v) {
    if (sides[v] == 3) all.kinds[v] = PartVertex::kLocked, ++n_locked;
  }
  double error = 0;
  for (const std::size_t side : {0U, 1U}) {
    SimplifyPart part{.points = mesh.vertices, .kinds = all.kinds, .unit = 0.05};
    for (const Triangle& t : mesh.faces) {
      if (side_of(t) == side) part.faces.push_back(t);
    }
    const SimplifiedPart found = simplify_part(part, 1000, HUGE_VAL);
    EXPECT_EQ(found.faces.size(), 1000U);
    ASSERT_EQ(found.origins.size(), 1000U);
    for (std::size_t i = 0; i < found.vertices.size(); ++i) {
      all.quadrics[found.vertices[i]].add(found.quadrics[i]);
    }
    for (std::size_t i = 1; i < found.steps.size(); ++i) {
      EXPECT_LT(found.steps[i].faces, found.steps[i - 1].faces);
      EXPECT_GE(found.steps[i].cost, found.steps[i - 1].cost);
    }
    EXPECT_EQ(found.steps.back().faces, 1000U);
    all.faces.insert(all.faces.end(), found.faces.begin(), found.faces.end());
    error = std::max(error, found.error);
  }
  const Inspection halves = inspect({.vertices = mesh.vertices, .faces = all.faces});
  EXPECT_TRUE(halves.closed && halves.manifold);
  EXPECT_EQ(halves.euler_characteristic, 2);
  std::set<std::uint32_t> left;
  for (const Triangle& t : all.faces) left.insert(t.begin(), t.end());
  std::size_t locked = 0;
  for (std::uint32_t v = 0; v < sides.size(); ++v) locked += sides[v] == 3 && left.contains(v);
  EXPECT_EQ(locked, n_locked);
  for (PartVertex& kind : all.kinds) {
    if (kind == PartVertex::kLocked) kind = PartVertex::kUnlocked;
  }
  const SimplifiedPart whole = simplify_part(all, 1000, HUGE_VAL);
  const Inspection found = inspect({.vertices = mesh.vertices, .faces = whole.faces});
  EXPECT_TRUE(found.closed && found.manifold);
  EXPECT_EQ(found.faces, 1000U);
  // The result is as good as for the whole mesh from the beginning.
  EXPECT_NEAR(whole.error, simplify(mesh, {.faces = 1000}).error, 0.15 * whole.error);
}

TEST(simplify, can_be_cancelled) {
  const Context context{.threads = 1, .progress = [](std::string_view, double) { return false; }};
  EXPECT_EQ(code_of([&] { simplify(icosphere(4), {.faces = 10}, context); }),
            ErrorCode::kCancelled);
}

Ring ring_of(const Mesh& mesh, std::uint32_t v) {
  Ring ring;
  find_ring(mesh.faces, make_vertex_stars(mesh.vertices.size(), mesh.faces), v, ring);
  return ring;
}

TEST(find_ring, follows_the_fan) {
  const Mesh mesh = square(2);
  const Ring inner = ring_of(mesh, 4);  // the middle
  EXPECT_EQ(inner.kind, RingKind::kClosed);
  EXPECT_EQ(inner.neighbours.size(), 6U);
  const Ring corner = ring_of(mesh, 0);
  EXPECT_EQ(corner.kind, RingKind::kOpen);
  EXPECT_EQ(corner.neighbours, (std::vector<std::uint32_t>{1, 4, 3}));  // counter-clockwise
  Mesh fans = joined(tetrahedron(), tetrahedron());
  for (Triangle& t : fans.faces) {
    for (std::uint32_t& v : t) v = v == 4 ? 0 : v;
  }
  EXPECT_EQ(ring_of(fans, 0).kind, RingKind::kComplex);
  EXPECT_EQ(ring_of(fans, 4).kind, RingKind::kComplex);  // in no triangle
  EXPECT_EQ(ring_of(fans, 1).kind, RingKind::kClosed);
}

}  // namespace
}  // namespace rholm
