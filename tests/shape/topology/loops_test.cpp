// Non-separating loops are found and cut. Oracles are rings of polygons and counts by inspect().
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "shape/topology/cut_graph.h"
#include "shape/topology/loops.h"
#include "shape/topology/mates.h"
#include "support/random_data.h"

namespace rholm {
namespace {

constexpr int kRing = 40, kTube = 12;

struct Surface {
  explicit Surface(const Mesh& given)
      : mesh(given),
        mates(find_mates(mesh.vertices.size(), mesh.faces)),
        outgoing(inner_outgoing(mesh.vertices.size(), mesh.faces, mates)),
        graph(make_cut_graph(mesh, mates)) {}

  Mesh mesh;
  std::vector<std::uint32_t> mates, outgoing;
  CutGraph graph;
};

Mesh without_triangle(Mesh mesh) {
  mesh.faces.pop_back();
  return mesh;
}

// Joins two rings where a triangle of each is missing.
Mesh double_torus() {
  Mesh both = torus(2, 0.5, kRing, kTube);
  const auto n = static_cast<std::uint32_t>(both.vertices.size());
  const Mesh other = both;
  for (const Vec3& v : other.vertices) both.vertices.push_back(v + Vec3{6, 0, 0});
  const Triangle a = both.faces.back();
  both.faces.pop_back();
  for (const Triangle& t : other.faces) {
    both.faces.push_back({t[0] + n, t[1] + n, t[2] + n});
  }
  const Triangle b = both.faces.back();
  both.faces.pop_back();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3, own = 2 - k, own_next = (own + 2) % 3;
    both.faces.push_back({a[k], a[next], b[own]});
    both.faces.push_back({a[next], b[own_next], b[own]});
  }
  return both;
}

TEST(mates, lead_back_along_the_same_edge) {
  const Surface s(torus(2, 0.5, kRing, kTube));
  for (std::uint32_t c = 0; c < s.mates.size(); ++c) {
    ASSERT_NE(s.mates[c], kNoMate);
    EXPECT_EQ(s.mates[s.mates[c]], c);
    EXPECT_EQ(start_of(s.mesh.faces, s.mates[c]), end_of(s.mesh.faces, c));
  }
}

TEST(mates, of_borders_are_none_and_their_vertices_are_not_inner) {
  const Surface s(without_triangle(icosphere(2)));
  EXPECT_EQ(std::count(s.mates.begin(), s.mates.end(), kNoMate), 3);
  EXPECT_EQ(std::count(s.outgoing.begin(), s.outgoing.end(), kNoMate), 3);
}

TEST(mates, of_two_fans_that_touch_in_a_vertex_are_no_inner_vertex) {
  Mesh two = icosphere(1);
  const auto n = static_cast<std::uint32_t>(two.vertices.size());
  const Mesh other = two;
  for (const Vec3& v : other.vertices) two.vertices.push_back(v + Vec3{0, 0, 2});
  const auto shared = [&](std::uint32_t v) { return v == 0 ? 0 : v + n; };
  for (const Triangle& t : other.faces) {
    two.faces.push_back({shared(t[0]), shared(t[1]), shared(t[2])});
  }
  EXPECT_EQ(Surface(two).outgoing[0], kNoMate);
}

TEST(cut_graph, has_no_edges_on_spheres_and_discs) {
  EXPECT_TRUE(Surface(icosphere(3)).graph.edges.empty());
  EXPECT_TRUE(Surface(without_triangle(icosphere(3))).graph.edges.empty());
}

TEST(cut_graph, is_crossed_an_even_number_of_times_around_every_triangle_and_vertex) {
  Mesh open = double_torus();
  open.faces.erase(open.faces.begin() + 100);
  open.faces.erase(open.faces.begin() + 300);
  for (const Mesh& mesh : {double_torus(), open}) {
    const Surface s(mesh);
    EXPECT_FALSE(s.graph.edges.empty());
    for (std::uint32_t c = 0; c < s.mates.size(); c += 3) {
      EXPECT_EQ(s.graph.crossed(c) ^ s.graph.crossed(c + 1) ^ s.graph.crossed(c + 2), 0U);
    }
    for (std::uint32_t c = 0; c < s.mates.size(); ++c) {
      if (s.mates[c] != kNoMate) {
        EXPECT_EQ(s.graph.crossed(c), s.graph.crossed(s.mates[c]));
      }
    }
  }
}

// Around a hole of an open surface there is also a loop: its border does not count.
TEST(cut_graph, tells_a_ring_from_a_disc) {
  Mesh ring = icosphere(3);
  std::erase_if(ring.faces,
                [&](const Triangle& t) { return std::abs(ring.vertices[t[0]].z) > 0.7; });
  const Surface s(ring);
  LoopSearch search(s.mesh, s.mates, s.outgoing, s.graph);
  std::uint32_t base = 0;
  while (std::abs(ring.vertices[base].z) > 0.1) ++base;
  const Loop loop = search.shortest(base, 7);
  // The length is below the equator's, up to the polygons, and above the length of the border at
  // 0.7.
  EXPECT_LT(loop.length, 1.05 * 2 * std::numbers::pi);
  EXPECT_GT(loop.length, 2 * std::numbers::pi * std::sqrt(1 - 0.49));
  EXPECT_TRUE(search.shortest(base, 4).corners.empty());
}

TEST(short_loops, of_a_torus_go_around_its_tube) {
  const Surface s(torus(2, 0.5, kRing, kTube));
  const double around = kTube * 2 * 0.5 * std::sin(std::numbers::pi / kTube);
  LoopSearch search(s.mesh, s.mates, s.outgoing, s.graph);
  for (std::uint32_t v = 0; v < s.mesh.vertices.size(); v += 7) {
    const Loop loop = search.shortest(v, 1.001 * around);
    ASSERT_EQ(loop.corners.size(), static_cast<std::size_t>(kTube));
    EXPECT_NEAR(loop.length, around, 1e-12);
    for (std::size_t i = 0; i < loop.corners.size(); ++i) {
      EXPECT_EQ(end_of(s.mesh.faces, loop.corners[i]),
                start_of(s.mesh.faces, loop.corners[(i + 1) % loop.corners.size()]));
    }
    EXPECT_TRUE(search.shortest(v, 0.999 * around).corners.empty());
  }
}

TEST(short_loops, of_a_neck_that_parts_a_surface_are_none) {
  const Surface s(double_torus());
  const auto length = [](const Mesh& mesh, const Triangle& t) {
    return norm(mesh.vertices[t[0]] - mesh.vertices[t[1]]) +
           norm(mesh.vertices[t[1]] - mesh.vertices[t[2]]) +
           norm(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
  };
  const Triangle neck = torus(2, 0.5, kRing, kTube).faces.back();
  LoopSearch search(s.mesh, s.mates, s.outgoing, s.graph);
  EXPECT_TRUE(search.shortest(neck[0], 1.5 * length(s.mesh, neck)).corners.empty());
}

TEST(cut_loop, takes_a_handle_and_neither_volume_nor_orientation) {
  for (const Mesh& mesh : {torus(2, 0.5, kRing, kTube), double_torus()}) {
    Surface s(mesh);
    s.mesh.attributes = {{"index", ScalarType::kFloat64, {}}};
    for (std::size_t v = 0; v < s.mesh.vertices.size(); ++v) {
      s.mesh.attributes[0].values.push_back(static_cast<double>(v));
    }
    const Inspection before = inspect(s.mesh);
    LoopSearch search(s.mesh, s.mates, s.outgoing, s.graph);
    const Loop loop = search.shortest(5, 4);
    std::vector<std::uint32_t> copies;
    cut_along(sides_of(loop.corners, s.mesh.faces, s.mates), s.mesh, copies);
    const Inspection after = inspect(s.mesh);
    EXPECT_TRUE(after.closed && after.manifold && after.oriented);
    EXPECT_EQ(after.components, 1U);
    EXPECT_EQ(after.euler_characteristic, before.euler_characteristic + 2);
    EXPECT_NEAR(after.volume, before.volume, 1e-12 * before.volume);
    // The area grows by two regular polygons.
    const double disc = kTube * 0.25 / 2 * std::sin(2 * std::numbers::pi / kTube);
    EXPECT_NEAR(after.area, before.area + 2 * disc, 1e-12 * before.area);
    ASSERT_EQ(copies.size(), static_cast<std::size_t>(kTube + 2));
    for (std::size_t i = 0; i < copies.size(); ++i) {
      EXPECT_EQ(s.mesh.attributes[0].values[before.vertices + i], copies[i]);
    }
  }
}

}  // namespace
}  // namespace rholm
