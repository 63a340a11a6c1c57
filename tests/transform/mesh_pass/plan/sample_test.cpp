#include "transform/mesh_pass/plan/sample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "rholm/primitives.h"
#include "support/adversarial_meshes.h"
#include "transform/norms/exact_norms.h"

namespace rholm {
namespace {

MeshSample sample_of(const Mesh& mesh, int degree = 16) {
  return sample_mesh(view_of(mesh), {}, degree);
}

// 2 000 triangles are all sampled: moments are cubatures of the exact integrals of the faces.
TEST(sample_mesh, knows_mean_and_norm_of_a_small_mesh) {
  const Mesh mesh = ellipsoid({1.5, 1, 0.8}, 3);
  const MeshSample sample = sample_of(mesh);
  const ExactNorms norms = exact_norms(view_of(mesh), {}, {});
  const double mean = sample.mean / sample.scale, norm = sample.norm / sample.scale;
  const double squares = 4 * std::numbers::pi * mean * mean + norm * norm;
  EXPECT_NEAR(squares / norms.radius_squared, 1, 0.1 * 0.15 * 0.15);  // edges of 0.15 radians
  EXPECT_EQ(sample.share, 1);
  EXPECT_EQ(sample.entries.size(), mesh.faces.size());
  EXPECT_EQ(sample.faces.size(), mesh.faces.size());
  EXPECT_FALSE(sample.overlaps);
}

TEST(sample_mesh, knows_every_edge_of_one_block_once) {
  const Mesh mesh = icosphere(1);  // 80 triangles, 120 edges
  const MeshSample sample = sample_of(mesh);
  EXPECT_EQ(sample.edges.size(), 120u);
  EXPECT_EQ(sample.twins.size(), 120u);
  EXPECT_NEAR(sample.edge_share, 1, 1e-15);
  for (const auto& [first, second] : sample.twins) {
    const Triangle &t = mesh.faces[first / 3], &u = mesh.faces[second / 3];
    EXPECT_EQ(t[first % 3], u[(second + 1) % 3]);  // half-edge i runs from corner i to the next
    EXPECT_EQ(t[(first + 1) % 3], u[second % 3]);
  }
}

TEST(sample_mesh, of_many_triangles_stands_for_all_of_them) {
  const Mesh mesh = test::adversarial::cube_sphere(60);
  const MeshSample sample = sample_of(mesh), whole = sample_of(test::adversarial::cube_sphere(12));
  EXPECT_LT(sample.entries.size(), mesh.faces.size() / 10);
  EXPECT_NEAR(sample.share * static_cast<double>(sample.entries.size()), 43200, 1e-6);
  EXPECT_NEAR(sample.mean / sample.scale, whole.mean / whole.scale, 0.03);
  EXPECT_NEAR(sample.norm / sample.scale, whole.norm / whole.scale, 0.3 * whole.norm);
}

TEST(sample_mesh, sees_which_edges_run_along_meridians_and_parallels) {
  const Mesh lattice = test::adversarial::lattice(20, 40);
  EXPECT_GT(sample_of(lattice).aligned, 0.3);
  // Some are aligned by chance.
  EXPECT_LT(sample_of(test::adversarial::turned(lattice, 0.7)).aligned, 0.05);
}

TEST(sample_mesh, sees_sheets_that_overlap) {
  Mesh twice = icosphere(2);
  const std::size_t n = twice.faces.size();
  for (std::size_t t = 0; t < n; ++t) {  // repeats half of the faces, flipped
    if (t % 2 != 0) continue;
    const Triangle f = twice.faces[t];
    twice.faces.push_back(f);
    twice.faces.push_back({f[0], f[2], f[1]});
  }
  EXPECT_TRUE(sample_of(twice).overlaps);
  EXPECT_FALSE(sample_of(icosphere(2)).overlaps);
}

TEST(sample_mesh, of_triangles_in_random_order_knows_no_edges) {
  const Mesh mesh = test::adversarial::in_random_order(test::adversarial::cube_sphere(40));
  EXPECT_EQ(sample_of(mesh).edge_share, 0);
}

TEST(sample_mesh, passes_over_blocks_with_indices_out_of_range) {
  Mesh mesh = icosphere(3);  // 10 blocks of 128
  mesh.faces[200][1] = 1u << 30;
  EXPECT_EQ(sample_of(mesh).faces.size(), mesh.faces.size() - 128);
}

// All faces have one size: squares and moduli of face weights -n . n / d2 follow their definition.
TEST(sample_mesh, sums_of_what_is_spread_are_those_of_all_faces_and_edges) {
  const Mesh mesh = icosphere(3);
  const MeshSample sample = sample_of(mesh);
  double faces = 0, faces2 = 0;
  for (const Triangle& t : mesh.faces) {
    const Vec3 a = sample.scale * mesh.vertices[t[0]], b = sample.scale * mesh.vertices[t[1]],
               c = sample.scale * mesh.vertices[t[2]];
    const Vec3 n = cross(b - a, c - a);
    const double weight = dot(n, n) / dot(n, a);
    faces += weight;
    faces2 += weight * weight;
  }
  double edges = 0, edges2 = 0;
  for (const MeshSample::Edge& edge : sample.edges) {
    edges += std::abs(edge.weight);
    edges2 += edge.weight * edge.weight;
  }
  EXPECT_NEAR(sample.modulus, faces + sample.edge_share * edges, 1e-9 * faces);
  EXPECT_NEAR(sample.source2, faces2 / 3 + sample.edge_share * edges2 / 2, 1e-9 * faces2);
}

}  // namespace
}  // namespace rholm
