#include "chart/star/direction_counts.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "chart/center/local_view.h"
#include "rholm/primitives.h"
#include "rholm/star.h"
#include "rholm/topology.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

// Counts the triangles that the half line meets, testing each triangle separately.
int meetings(const Mesh& mesh, const Vec3& center, const Vec3& direction) {
  int count = 0;
  for (const Triangle& t : mesh.faces) {
    const Vec3 a = mesh.vertices[t[0]] - center, b = mesh.vertices[t[1]] - center;
    const Vec3 c = mesh.vertices[t[2]] - center;
    const double det = dot(a, cross(b, c));
    const double wa = dot(direction, cross(b, c)) / det, wb = dot(direction, cross(c, a)) / det;
    const double wc = dot(direction, cross(a, b)) / det;
    count += wa > 0 && wb > 0 && wc > 0;
  }
  return count;
}

Mesh together(Mesh a, const Mesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const Triangle& t : b.faces) {
    a.faces.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
  }
  return a;
}

// Returns all faces of a mesh, which include the faces with low planes.
std::vector<std::uint32_t> all_faces(const Mesh& mesh) {
  std::vector<std::uint32_t> all(mesh.faces.size());
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

// Centres lie within a body, in its hole and beside it; bodies are inside out, two, or nested.
// Faces are as wide as a third of the sphere and as narrow as the solid angle of one direction.
TEST(count_meetings, are_those_of_each_triangle) {
  Mesh inward = test::rotated(bumpy_sphere(2, 0.3));
  flip(inward);
  const Mesh ring = test::rotated(torus(2, 0.5, 40, 20));
  const Mesh ball = test::rotated(bumpy_sphere(3, 0.3)), cube = test::rotated(box({1, 2, 3}));
  const std::vector<std::pair<Mesh, std::vector<Vec3>>> cases = {
      {ring, {{0, 0, 0}, {2.1, 0.1, 0.05}, {0.3, -0.1, 0.7}, {9, 1, 2}}},
      {ball, {{0.1, 0.05, -0.2}, {1.4, 0.2, 0.1}}},
      {inward, {{0.1, 0.05, -0.2}, {2.5, 0.2, 0.1}}},
      {cube, {{0.1, 0.2, 0.3}, {3, 0.2, 0.1}, {0.3, 5, -4}}},
      {together(ball, cube), {{0.1, 0.2, 0.3}, {0.9, 0.2, 1.1}}},
      {together(ring, ball), {{0.1, 0.2, 0.3}, {0.2, 2.1, 0.1}}}};
  for (const auto& [mesh, centers] : cases) {
    for (const Vec3& center : centers) {
      constexpr std::size_t n = 1500;
      const LocalView view = local_view(view_of(mesh), {});
      const auto counts = count_meetings(view, center, n, all_faces(mesh), {});
      ASSERT_TRUE(counts.has_value());
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_EQ((*counts)[i], meetings(mesh, center, lattice_direction(i, n)))
            << mesh.faces.size() << ' ' << center.x << ' ' << i;
      }
    }
  }
}

// The faces that the star check passes on are sufficient.
TEST(count_meetings, of_the_star_check_are_those_of_each_triangle) {
  const Mesh mesh = test::rotated(torus(2, 0.5, 40, 20));
  for (const Vec3& center : {Vec3{2.1, 0.1, 0.05}, Vec3{0.3, -0.1, 0.7}}) {
    constexpr int kRays = 1500;
    const StarReport report = check_star(mesh, center, kRays);
    int once = 0, missed = 0;
    for (std::size_t i = 0; i < kRays; ++i) {
      const int times = meetings(mesh, center, lattice_direction(i, kRays));
      once += times == 1;
      missed += times == 0;
    }
    EXPECT_EQ(report.once_share, static_cast<double>(once) / kRays);
    EXPECT_EQ(report.missed_share, static_cast<double>(missed) / kRays);
  }
}

// A centre in a face or corner sees a half or an eighth of all directions through it.
TEST(count_meetings, are_left_to_rays_from_the_surface) {
  const Mesh cube = box({1, 2, 3});
  for (const Vec3& center : {Vec3{0.5, 0.1, 0.2}, Vec3{-0.5, 0.1, 0.2}, Vec3{0.5, 1, 1.5}}) {
    EXPECT_FALSE(count_meetings(local_view(view_of(cube), {}), center, 100, all_faces(cube), {})
                     .has_value());
    const StarReport report = check_star(cube, center, 1000);
    EXPECT_GT(report.once_share, 0.05);
    EXPECT_LT(report.once_share, 0.95);
  }
  // A face that is seen edge-on from outside does no harm.
  EXPECT_TRUE(count_meetings(local_view(view_of(cube), {}), {0.5, 9, 0.2}, 100, all_faces(cube), {})
                  .has_value());
}

}  // namespace
}  // namespace rholm
