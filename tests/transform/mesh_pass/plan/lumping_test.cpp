#include "transform/mesh_pass/plan/lumping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "rholm/primitives.h"
#include "support/test_shapes.h"
#include "transform/mesh_pass/pass.h"
#include "transform/mesh_pass/plan/plan.h"

namespace rholm {
namespace {

// Returns n triangles whose faces have the errors 1, 2, 4, ... and half-edges none; all are known.
MeshSample doubling_sample(int n) {
  MeshSample sample;
  for (int k = 0; k < n; ++k) {
    const double error2 = std::exp2(k);
    sample.entries.push_back({error2, error2, 1});
  }
  sample.edges.push_back({0, 0, 0, 0, 0});
  sample.edge_share = 1;
  return sample;
}

TEST(tolerance_of, leaves_no_more_than_its_part_of_what_is_allowed) {
  const MeshSample sample = doubling_sample(30);
  for (double allowed2 = 1; allowed2 < 1e10; allowed2 *= 7) {
    const double tolerance2 = tolerance_of(sample, allowed2);
    double left = 0;
    for (const MeshSample::Entry& entry : sample.entries) {
      if (entry.error2 <= tolerance2) left += entry.error2;
    }
    const bool some_noded = noded_share(sample, tolerance2) > 0;
    EXPECT_LE(left, (1 - node_share2(some_noded)) * allowed2) << allowed2;
  }
}

TEST(tolerance_of, grows_with_what_is_allowed) {
  const MeshSample sample = doubling_sample(30);
  double before = 0;
  for (double allowed2 = 1; allowed2 < 1e12; allowed2 *= 3) {
    const double tolerance2 = tolerance_of(sample, allowed2);
    EXPECT_GE(tolerance2, before) << allowed2;
    before = tolerance2;
  }
  EXPECT_EQ(noded_share(sample, before), 0);
}

TEST(tolerance_of, is_zero_where_nothing_may_be_left) {
  EXPECT_EQ(tolerance_of(doubling_sample(10), 1e-9), 0);
}

// The two half-edges of each edge cancel: triangles that are far too large alone are lumped.
TEST(tolerance_of, counts_edges_by_the_sum_of_their_half_edges) {
  MeshSample sample;
  for (int k = 0; k < 100; ++k) {
    sample.entries.push_back({1, 0, 1});
    sample.edges.push_back({1, 1, 1, -1, 0});
  }
  sample.edge_share = 1;
  EXPECT_EQ(noded_share(sample, tolerance_of(sample, 100)), 0);
  for (MeshSample::Edge& edge : sample.edges) edge.upper = 1;
  EXPECT_EQ(noded_share(sample, tolerance_of(sample, 100)), 1);
}

TEST(noded_share, is_the_part_of_the_triangles_beyond_the_tolerance) {
  EXPECT_EQ(noded_share(doubling_sample(8), 16), 3.0 / 8);  // faces 32, 64 and 128
  EXPECT_EQ(noded_share(doubling_sample(8), 0), 1);
  EXPECT_EQ(noded_share(MeshSample{}, 1), 0);
}

TEST(hermite_lumps, are_none_where_nothing_is_known_or_nothing_may_be_left) {
  EXPECT_FALSE(hermite_lumps(MeshSample{}, 1, 20).has_value());
  const Mesh mesh = bumpy_sphere(4);
  EXPECT_FALSE(hermite_lumps(sample_mesh(view_of(mesh), {}, 32), 0, 20).has_value());
}

// For a mesh too coarse for values and gradients: a smaller allowed error needs more nodes and
// costs more.
TEST(hermite_lumps, cost_more_the_less_they_may_leave) {
  const Mesh mesh = bumpy_sphere(4);
  const MeshSample sample = sample_mesh(view_of(mesh), {}, 64);
  double cost = 0;
  for (double allowed2 = 1e4; allowed2 > 1e-12; allowed2 /= 100) {
    const std::optional<HermiteLumps> lumps = hermite_lumps(sample, allowed2, 20);
    ASSERT_TRUE(lumps.has_value());
    // The search has steps of a factor 1.2.
    EXPECT_GE(lumps->cost, cost / 1.2) << allowed2;
    EXPECT_GE(lumps->node_share, 0);
    EXPECT_LE(lumps->node_share, 1);
    EXPECT_GE(lumps->between, 0);
    // Rules with more nodes follow rules with fewer nodes.
    EXPECT_LE(lumps->edge_reach2[0], lumps->edge_reach2[1]);
    EXPECT_LE(lumps->face_reach2[0], lumps->face_reach2[1]);
    cost = lumps->cost;
  }
}

// Compares with the nodes of a pass in which every triangle has its own nodes.
TEST(own_nodes_of, are_those_that_a_pass_writes) {
  const Mesh mesh = test::rotated(bumpy_sphere(4));
  int compared = 0;
  for (const int degree : {40, 90}) {
    for (const double precision : {1e-8, 1e-11}) {
      const MeshPassResult pass =
          mesh_pass(view_of(mesh), {.degree = degree, .precision = precision}, {});
      if (pass.report.lumped_faces > 0) continue;
      ++compared;
      const MeshSample sample = sample_mesh(view_of(mesh), {}, degree);
      const MeshPlan plan = plan_mesh(view_of(mesh), sample, {}, degree, precision, {});
      const double each =
          static_cast<double>(pass.report.nodes) / static_cast<double>(mesh.faces.size());
      EXPECT_NEAR(own_nodes_of(sample, plan.divided), each, 0.3 * each) << degree << precision;
      EXPECT_GT(own_nodes_of(sample, plan.divided), 5);
    }
  }
  EXPECT_GT(compared, 1);
}

}  // namespace
}  // namespace rholm
