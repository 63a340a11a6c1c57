#include "shape/queries/near_faces.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "base/random.h"
#include "rholm/primitives.h"
#include "shape/queries/triangle_tree.h"

namespace rholm {
namespace {

// Returns balls about points of faces, moved by up to `reach`, that reach the surface.
Balls balls_on(const Mesh& mesh, std::size_t n, double reach, std::uint64_t seed) {
  Balls balls;
  for (std::size_t k = 0; k < n; ++k) {
    const auto u = [&](std::size_t j) { return random_uniform(seed, 8 * k + j); };
    const auto t = static_cast<std::size_t>(u(0) * static_cast<double>(mesh.faces.size()));
    const Triangle& f = mesh.faces[t];
    const double a = u(1), b = (1 - a) * u(2);
    const Vec3 x =
        a * mesh.vertices[f[0]] + b * mesh.vertices[f[1]] + (1 - a - b) * mesh.vertices[f[2]];
    const Vec3 away = reach * Vec3{u(3) - 0.5, u(4) - 0.5, u(5) - 0.5};
    balls.add(x + away, norm(away));
  }
  return balls;
}

// Faces are much smaller than the cells of the balls, as large as the cells, and much larger.
TEST(faces_near, have_the_closest_points_of_the_whole_mesh) {
  for (const Mesh& mesh : {bumpy_sphere(5, 0.5), bumpy_sphere(2, 0.5), box({1, 2, 3}, 1)}) {
    const TriangleTree tree(mesh);
    for (const double reach : {0.0, 1e-6, 1e-3, 0.1, 3.0}) {
      const Balls balls = balls_on(mesh, 300, reach, 1);
      const Mesh near = faces_near(view_of(mesh), {}, 1, balls, {});
      ASSERT_FALSE(near.faces.empty());
      const TriangleTree near_tree(near);
      for (const Vec3& center : balls.centers) {
        // Each tree computes in its own frame.
        EXPECT_NEAR(near_tree.closest(center).distance, tree.closest(center).distance, 1e-14);
      }
    }
  }
}

// All balls are in one place: faces outside their box are left out.
TEST(faces_near, are_few_where_balls_are_small) {
  const Mesh mesh = bumpy_sphere(6, 0.5);
  EXPECT_LT(faces_near(view_of(mesh), {}, 1, balls_on(mesh, 100, 1e-3, 2), {}).faces.size(),
            mesh.faces.size() / 20);
  Balls one;
  one.add(mesh.vertices[7], 1e-3);
  one.add(1.001 * mesh.vertices[7], 2e-3);
  EXPECT_LT(faces_near(view_of(mesh), {}, 1, one, {}).faces.size(), 20);
}

TEST(faces_near, are_in_the_coordinates_of_the_balls) {
  Mesh mesh = box({2, 2, 2}, 1);
  const Vec3 origin = {10, 20, 30};
  for (Vec3& v : mesh.vertices) v = 0.5 * v + origin;
  Balls balls;
  balls.add({1.25, 0, 0}, 0.25);
  const Mesh near = faces_near(view_of(mesh), origin, 2, balls, {});
  EXPECT_DOUBLE_EQ(TriangleTree(near).closest(Vec3{1.25, 0, 0}).distance, 0.25);
}

}  // namespace
}  // namespace rholm
