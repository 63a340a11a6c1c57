// Bounding boxes of meshes in memory of the caller.
#include "shape/vertex_range.h"

#include <gtest/gtest.h>

#include <limits>

#include "rholm/primitives.h"
#include "rholm/topology.h"
#include "support/packed_mesh.h"
#include "support/targets.h"

namespace rholm {
namespace {

using test::packed;
using test::PackedMesh;

// Compares ranges of 1 ... 33 vertices that begin anywhere with a loop over single vertices.
template <class T>
void expect_any_range(const Mesh& mesh) {
  const PackedMesh bytes = packed<T>(mesh), apart = packed<T>(mesh, 8);
  for (std::size_t n = 1; n <= 33; ++n) {
    const std::size_t begin = 5 * n;
    for (const MeshView& vertices : {bytes.view, apart.view}) {
      const VertexRange range = vertex_range(vertices, begin, begin + n);
      VertexRange expected;
      for (std::size_t i = begin; i < begin + n; ++i) {
        const Vec3 v = vertices.vertex(i);
        expected.add(0, v.x, v.x), expected.add(1, v.y, v.y), expected.add(2, v.z, v.z);
      }
      EXPECT_TRUE(range.finite);
      for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(range.min[k], expected.min[k]) << n;
        EXPECT_EQ(range.max[k], expected.max[k]) << n;
      }
    }
  }
}

TEST(vertex_range, takes_any_number_of_vertices) {
  const Mesh mesh = bumpy_sphere(3);
  test::for_each_target([&](const char* target) {
    SCOPED_TRACE(target);
    expect_any_range<float>(mesh);
    expect_any_range<double>(mesh);
  });
}

TEST(vertex_range, tells_of_coordinates_that_are_not_finite_wherever_they_stand) {
  for (const double bad :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    for (std::size_t i = 0; i < 40; ++i) {
      Mesh mesh = bumpy_sphere(1);
      (i % 3 == 0   ? mesh.vertices[i].x
       : i % 3 == 1 ? mesh.vertices[i].y
                    : mesh.vertices[i].z) = bad;
      const PackedMesh doubles = packed<double>(mesh), floats = packed<float>(mesh, 4);
      EXPECT_FALSE(vertex_range(doubles.view, 0, mesh.vertices.size()).finite) << i;
      EXPECT_FALSE(vertex_range(floats.view, 0, mesh.vertices.size()).finite) << i;
    }
  }
}

TEST(diagonal_of, is_that_of_the_bounding_box) {
  const Mesh mesh = box({1, 2, 3}, 2);
  EXPECT_DOUBLE_EQ(diagonal_of(view_of(mesh), {.threads = 1}), bounds(mesh.vertices).diagonal());
}

}  // namespace
}  // namespace rholm
