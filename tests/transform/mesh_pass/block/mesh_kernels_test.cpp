// The kernels of the mesh pass with 1 ... 33 triangles or vertices, with every instruction set, on
// memory full of NaN. The reference processes single elements one after the other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "base/aligned_array.h"
#include "rholm/primitives.h"
#include "support/packed_mesh.h"
#include "support/random_data.h"
#include "support/targets.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/vertex_lumps.h"

namespace rholm {
namespace {

constexpr std::size_t kMost = 33;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Uses this rule with Hessians (for edges at most their last one), or gradients only.
BlockParameters parameters_of(int rule, const MeshView& mesh) {
  BlockParameters parameters;
  parameters.center = {0.1, 0.05, -0.1};
  parameters.degree = 16;
  parameters.tolerance2 = parameters.mean_reach2 = parameters.largest = kInfinity;
  parameters.per_weight = parameters.per_gradient = 0x1p20;
  parameters.sampled_names = std::uint32_t{1} << 31;  // half of all names
  parameters.largest_index = static_cast<std::uint32_t>(mesh.n_vertices - 1);
  if (rule >= 0) {
    parameters.hessians = true;
    parameters.per_hessian = parameters.per_weight;
    const auto limits = [&](auto& reach2) {
      for (std::size_t k = 0; k < reach2.size(); ++k) {
        reach2[k] = static_cast<int>(k) < rule ? 0 : kInfinity;
      }
    };
    limits(parameters.edge_reach2);
    limits(parameters.face_reach2);
  }
  return parameters;
}

template <typename T>
void expect_same_lump(const VertexLump<T>& a, const VertexLump<T>& b) {
  for (int c = 0; c < 4; ++c) EXPECT_EQ(a.value[c], b.value[c]);
}

// Compares triangle t of a block with the only triangle of another block.
template <typename T>
void expect_same_triangle(const TriangleBlock<T>& all, std::size_t t, const TriangleBlock<T>& one,
                          const BlockParameters& parameters) {
  EXPECT_EQ(all.flag[t], one.flag[0]);
  EXPECT_EQ(all.face_weight[t], one.face_weight[0]);
  EXPECT_EQ(all.error2[t], one.error2[0]);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(all.hash[i][t], one.hash[i][0]);
    EXPECT_EQ(all.edge_weight[i][t], one.edge_weight[i][0]);
    EXPECT_EQ(all.sampled[i][t / 8] >> t % 8 & 1, one.sampled[i][0] & 1);
    expect_same_lump(all.lump[i][lump_slot<T>(t)], one.lump[i][0]);
    if (!parameters.hessians) continue;
    expect_same_lump(all.hessian[0][i][lump_slot<T>(t)], one.hessian[0][i][0]);
    expect_same_lump(all.hessian[1][i][lump_slot<T>(t)], one.hessian[1][i][0]);
    ASSERT_EQ(all.edge_rule[i][t], one.edge_rule[i][0]);
    if (one.edge_rule[i][0] == 0) continue;
    EXPECT_EQ(all.edge_node[i][t], one.edge_node[i][0]);
  }
  if (!parameters.hessians) return;
  ASSERT_EQ(all.face_rule[t], one.face_rule[0]);
  if (one.face_rule[0] == 0) return;
  EXPECT_EQ(all.center_node[t], one.center_node[0]);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(all.orbit_node[k][t], one.orbit_node[k][0]);
}

template <typename T>
void expect_single_triangles(const MeshView& mesh, int rule) {
  const BlockParameters parameters = parameters_of(rule, mesh);
  const auto all = std::make_unique<TriangleBlock<T>>(), one = std::make_unique<TriangleBlock<T>>();
  BlockSums expected = no_triangles();
  for (std::size_t n = 1; n <= kMost; ++n) {
    SCOPED_TRACE(n);
    BlockSums sums = no_triangles();
    work_block(mesh, 0, n, parameters, *all, sums);
    work_block(mesh, n - 1, 1, parameters, *one, expected);
    expect_same_triangle(*all, n - 1, *one, parameters);
    EXPECT_EQ(sums.hash1, expected.hash1);
    EXPECT_EQ(sums.hash2, expected.hash2);
    EXPECT_EQ(sums.min_d2, expected.min_d2);
    EXPECT_EQ(sums.min_cos2, expected.min_cos2);
    EXPECT_EQ(sums.max_edge2, expected.max_edge2);
    EXPECT_NEAR(sums.volume6, expected.volume6, 1e-13);
    EXPECT_NEAR(sums.mean, expected.mean, 1e-13);
    // With zero rules all weights are rounding.
    EXPECT_NEAR(sums.face_error2, expected.face_error2, 1e-13 * (1 + expected.face_error2));
    EXPECT_EQ(sums.nodes, 0u);
    EXPECT_EQ(sums.probe, 0);
  }
}

TEST(mesh_kernels, triangles_do_not_depend_on_those_beside_them) {
  const Mesh mesh = bumpy_sphere(2, 0.3);
  const test::PackedMesh floats = test::packed<float>(mesh), doubles = test::packed<double>(mesh);
  test::for_each_target([&](const char* target) {
    for (const MeshView& view : {floats.view, doubles.view}) {
      for (int rule = -1; rule < static_cast<int>(kHermiteFaceRules); ++rule) {
        SCOPED_TRACE(std::string(target) + " " + std::to_string(rule));
        expect_single_triangles<std::int32_t>(view, rule);
        expect_single_triangles<double>(view, rule);
      }
    }
  });
}

TEST(mesh_kernels, largest_index_is_that_of_any_number_of_triangles) {
  const test::PackedMesh mesh = test::packed<float>(bumpy_sphere(2));
  test::for_each_target([&](const char* target) {
    for (std::size_t end = 1; end <= mesh.view.n_faces; ++end) {
      const std::size_t n = std::min(end, end % kMost + 1);
      std::uint32_t largest = 0;
      for (std::size_t t = end - n; t < end; ++t) {
        for (const std::uint32_t i : mesh.view.triangle(t)) largest = std::max(largest, i);
      }
      EXPECT_EQ(largest_index(mesh.view, end - n, n), largest) << target << " " << n;
    }
  });
}

template <typename L, typename T>
void expect_single_vertices(const MeshView& mesh, bool hessians) {
  const BlockParameters parameters = parameters_of(hessians ? 1 : -1, mesh);
  AlignedArray<VertexLump<L>> lumps(kLumpsPerBlock), single(kLumpsPerBlock);
  const std::size_t parts = lumps_per_vertex(hessians);
  const auto all = std::make_unique<SourceBatch<T>>(), one = std::make_unique<SourceBatch<T>>();
  LumpSums expected, expected_squares;
  // Vertices are consecutive, then have gaps, up to the last vertex.
  std::vector<std::uint32_t> numbers(kMost);
  for (std::size_t j = 0; j < kMost; ++j) {
    const std::size_t gaps = mesh.n_vertices - kMost;
    numbers[j] = static_cast<std::uint32_t>(j + (2 * j < kMost ? 0 : gaps * j / (kMost - 1)));
  }
  for (std::size_t n = 1; n <= kMost; ++n) {
    SCOPED_TRACE(n);
    // Zeros fill the last vectors, as in LumpArrays::sums().
    for (std::size_t k = 0; k < parts; ++k) {
      for (std::size_t i = 0; i < 40; ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
          const double value = std::round(test::random_in(-1e6, 1e6, k + 1, 4 * i + c));
          VertexLump<L>& lump = lumps[k * kVerticesPerBlock + i];
          lump.value[c] = static_cast<L>(i < n ? value : 0);
          if (i < 8) single[k * kVerticesPerBlock + i].value[c] = 0;
        }
      }
      single[k * kVerticesPerBlock] = lumps[k * kVerticesPerBlock + n - 1];
    }
    expected.add(sum_lumps(single.data(), 1));
    const LumpSums sums = sum_lumps(lumps.data(), n);
    EXPECT_EQ(sums.weight, expected.weight);
    EXPECT_NEAR(sums.weight2, expected.weight2, 1e-13 * expected.weight2);
    EXPECT_NEAR(sums.gradient2, expected.gradient2, 1e-13 * expected.gradient2);
    const LumpSums squares = load_vertices(mesh, numbers.data(), n, parameters, lumps.data(), *all);
    expected_squares.add(
        load_vertices(mesh, numbers.data() + n - 1, 1, parameters, single.data(), *one));
    EXPECT_NEAR(squares.hessian2, expected_squares.hessian2, 1e-12 * expected_squares.hessian2);
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(all->x[k][n - 1], one->x[k][0]);
      EXPECT_EQ(all->gradient[k][n - 1], one->gradient[k][0]);
    }
    EXPECT_EQ(all->value[n - 1], one->value[0]);
    for (std::size_t k = 0; hessians && k < 6; ++k) {
      EXPECT_EQ(all->hessian[k][n - 1], one->hessian[k][0]);
    }
  }
}

TEST(mesh_kernels, vertices_do_not_depend_on_those_beside_them) {
  const Mesh mesh = bumpy_sphere(2, 0.3);
  const test::PackedMesh floats = test::packed<float>(mesh), doubles = test::packed<double>(mesh);
  test::for_each_target([&](const char* target) {
    for (const MeshView& view : {floats.view, doubles.view}) {
      for (const bool hessians : {false, true}) {
        SCOPED_TRACE(target);
        expect_single_vertices<std::int32_t, float>(view, hessians);
        expect_single_vertices<double, double>(view, hessians);
      }
    }
  });
}

}  // namespace
}  // namespace rholm
