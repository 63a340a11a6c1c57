// Contributions of blocks of triangles to their vertices.
#include "transform/mesh_pass/scatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "rholm/primitives.h"
#include "support/test_meshes.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

// All triangles that can be lumped are lumped, in quanta of 2^-26, without nodes between corners.
BlockParameters parameters_for(const Mesh& mesh) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  BlockParameters parameters;
  parameters.degree = 16;
  parameters.tolerance2 = parameters.mean_reach2 = parameters.largest = kInfinity;
  parameters.per_weight = parameters.per_gradient = parameters.per_hessian = 0x1p26;
  parameters.edge_reach2.fill(kInfinity);
  parameters.face_reach2.fill(kInfinity);
  parameters.largest_index = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
  return parameters;
}

// Returns sums of lumps at vertices, with blocks taken forwards or backwards.
template <typename T>
std::vector<VertexLump<T>> scattered(const Mesh& mesh, const BlockParameters& parameters,
                                     bool backwards) {
  std::vector<VertexLump<T>> lumps(lumps_per_vertex(parameters.hessians) * mesh.vertices.size(),
                                   VertexLump<T>{});
  const std::size_t n_faces = mesh.faces.size();
  const std::size_t blocks = (n_faces + kTrianglesPerBlock - 1) / kTrianglesPerBlock;
  const auto block = std::make_unique<TriangleBlock<T>>();
  BlockSums sums = no_triangles();
  for (std::size_t k = 0; k < blocks; ++k) {
    const std::size_t first = (backwards ? blocks - 1 - k : k) * kTrianglesPerBlock;
    const std::size_t n = std::min(kTrianglesPerBlock, n_faces - first);
    work_block(view_of(mesh), first, n, parameters, *block, sums);
    const MeshView view = view_of(mesh);
    const CornerPlaces places{view.faces + first * view.face_stride, view.face_stride};
    scatter_lumps(places, n, parameters.hessians, *block, lumps.data());
  }
  return lumps;
}

template <typename T>
void expect_exact_sums(bool hessians) {
  const Mesh mesh = test::rotated(bumpy_sphere(4));
  BlockParameters parameters = parameters_for(mesh);
  parameters.center = {0.1, 0.2, 0.1};
  parameters.hessians = hessians;
  const auto forwards = scattered<T>(mesh, parameters, false);
  const auto backwards = scattered<T>(mesh, parameters, true);
  double sum = 0;
  for (std::size_t i = 0; i < forwards.size(); ++i) {
    for (int k = 0; k < 4; ++k) EXPECT_EQ(forwards[i].value[k], backwards[i].value[k]);
    if (i % lumps_per_vertex(hessians) == 0) sum += static_cast<double>(forwards[i].value[0]);
  }
  // Each corner of each triangle is rounded by half a quantum at most.
  EXPECT_LT(std::abs(sum), 1.5 * static_cast<double>(mesh.faces.size()));
}

TEST(scatter, sums_at_vertices_are_the_same_in_any_order) {
  for (const bool hessians : {false, true}) {
    expect_exact_sums<std::int32_t>(hessians);
    expect_exact_sums<double>(hessians);
  }
}

TEST(scatter, triangles_that_need_nodes_do_not_reach_the_vertices) {
  const Mesh mesh = icosphere(2);
  BlockParameters parameters = parameters_for(mesh);
  parameters.tolerance2 = 0;
  for (const auto& lump : scattered<double>(mesh, parameters, false)) {
    for (const double value : lump.value) EXPECT_EQ(value, 0);
  }
}

}  // namespace
}  // namespace rholm
