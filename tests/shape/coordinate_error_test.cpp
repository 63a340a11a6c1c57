#include "shape/coordinate_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "rholm/primitives.h"
#include "support/random_data.h"

namespace rholm {
namespace {

using test::random_direction;
using test::random_in;

// `volatile` is needed: GCC 12 omits the conversion in the last rounds of a vectorised loop.
double to_single(double x) {
  const volatile float single = static_cast<float>(x);
  return single;
}

template <typename Change>
Mesh changed(Mesh mesh, const Change& change) {
  for (Vec3& v : mesh.vertices) v = {change(v.x), change(v.y), change(v.z)};
  return mesh;
}

Mesh turned_sphere() {
  Mesh mesh = icosphere(3);
  for (Vec3& v : mesh.vertices) {
    v = 25 * Vec3{0.8 * v.x - 0.6 * v.y, 0.6 * v.x + 0.8 * v.y, v.z} + Vec3{1.7, 0, 0};
  }
  return mesh;
}

TEST(coordinate_error, is_a_step_of_what_the_coordinates_are_written_in) {
  const Mesh mesh = turned_sphere();
  const auto error_of = [](const Mesh& m) { return coordinate_error(view_of(m)).x; };
  const double largest = bounds(mesh.vertices).max.x;
  EXPECT_NEAR(error_of(mesh), 0x1p-43 * largest, 1e-18);
  EXPECT_NEAR(error_of(changed(mesh, to_single)), 0x1p-23 * largest, 1e-12);
  const auto to_decimals = [](double power) {
    return [power](double x) { return std::round(x * power) / power; };
  };
  EXPECT_NEAR(error_of(changed(mesh, to_decimals(1e4))), 1e-4, 1e-15);
  EXPECT_NEAR(error_of(changed(mesh, to_decimals(1e6))), 1e-6, 1e-15);
  // Single precision is recognised in numbers that are written with nine decimals.
  const auto written = [&](double x) { return to_decimals(1e9)(to_single(x)); };
  EXPECT_NEAR(error_of(changed(mesh, written)), 0x1p-23 * largest, 1e-12);
}

// A box of round numbers counts as exact, as does a mesh all of whose faces would be thin.
TEST(coordinate_error, of_round_numbers_and_of_what_is_finer_is_that_of_double_precision) {
  EXPECT_NEAR(
      coordinate_error(view_of(changed(box({25.4, 10, 3}, 2), [](double x) { return x + 0.1; }))).x,
      0x1p-43 * 12.8, 1e-14);
  const Mesh far = changed(box({2, 2, 2}, 1), [](double x) { return x + 1e8; });
  EXPECT_LT(coordinate_error(view_of(far)).x, 1e-4);
}

// Corners are moved at random within the error: the bound holds, and is reached within a factor.
TEST(plane_doubt, bounds_how_far_corners_within_their_errors_turn_the_plane) {
  const Vec3 error{1e-4, 2e-4, 5e-5};
  for (std::uint64_t i = 0; i < 200; ++i) {
    const double width = std::exp2(-random_in(0, 9, 1, i));
    const Vec3 a = random_direction(i, 0), b = random_direction(i, 1);
    const std::array<Vec3, 3> p = {a, b, 0.5 * (a + b) + width * random_direction(i, 2)};
    const FaceNormal normal = face_normal(p);
    const PlaneDoubt doubt = plane_doubt(p, normal, error);
    if (doubt.thin) continue;
    double most = 0;
    for (std::uint64_t k = 0; k < 200; ++k) {
      std::array<Vec3, 3> q = p;
      for (std::uint64_t c = 0; c < 3; ++c) {
        const auto sign = [&](std::uint64_t axis) {
          return random_in(-1, 1, i, 1000 + 9 * k + 3 * c + axis) < 0 ? -1 : 1;
        };
        q[c] += Vec3{sign(0) * error.x, sign(1) * error.y, sign(2) * error.z};
      }
      const Vec3 other = face_normal(q).twice_area;
      most = std::max(most, norm(cross(other, normal.twice_area)) / dot(other, normal.twice_area));
    }
    EXPECT_LE(most, 1.01 * doubt.turn);
    EXPECT_GE(most, 0.1 * doubt.turn);
  }
}

TEST(plane_doubt, calls_a_face_thin_where_its_corners_may_lie_on_a_line) {
  const Vec3 error{1e-7, 1e-7, 1e-7};
  EXPECT_TRUE(is_thin({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, 1.9e-7, 0}}, error));
  EXPECT_FALSE(is_thin({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, 2.1e-7, 0}}, error));
  EXPECT_TRUE(is_thin({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 0, 0}}, {}));
  // Errors along a needle do not reduce its width.
  EXPECT_FALSE(is_thin({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, 1e-9, 0}}, {1e-7, 1e-10, 1e-10}));
}

}  // namespace
}  // namespace rholm
