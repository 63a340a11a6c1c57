#include "rholm/primitives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "rholm/error.h"
#include "rholm/topology.h"

namespace rholm {
namespace {

using std::numbers::pi;

void expect_sound(const Mesh& mesh, std::size_t genus, const char* what) {
  const Inspection shape = inspect(mesh);
  EXPECT_TRUE(shape.closed && shape.manifold && shape.oriented) << what;
  EXPECT_FALSE(shape.inside_out) << what;
  EXPECT_EQ(shape.components, 1u) << what;
  EXPECT_EQ(shape.genus, genus) << what;
  EXPECT_EQ(shape.degenerate_faces, 0u) << what;
  EXPECT_EQ(shape.isolated_vertices, 0u) << what;
}

TEST(primitives, are_closed_manifold_and_outward) {
  expect_sound(icosphere(0), 0, "icosahedron");
  expect_sound(icosphere(3), 0, "icosphere");
  expect_sound(latitude_longitude_sphere(1, 3), 0, "bipyramid");
  expect_sound(latitude_longitude_sphere(7, 10), 0, "latitude-longitude sphere");
  expect_sound(ellipsoid({1, 2, 0.1}, 2), 0, "ellipsoid");
  expect_sound(box({1, 2, 3}), 0, "box");
  expect_sound(box({0.1, 0.7, 3}, 5), 0, "fine box");
  expect_sound(torus(2, 1, 12, 9), 1, "torus");
  expect_sound(bumpy_sphere(3, 0.9, 5), 0, "bumpy sphere");
}

TEST(icosphere, has_20_times_4_to_the_n_triangles_and_vertices_on_the_unit_sphere) {
  std::size_t power = 1;
  for (int n = 0; n <= 5; ++n, power *= 4) {
    const Mesh mesh = icosphere(n);
    EXPECT_EQ(mesh.faces.size(), 20 * power);
    EXPECT_EQ(mesh.vertices.size(), 10 * power + 2);
    // A normalised vector has the length 1 within 2 ulp.
    for (const Vec3& v : mesh.vertices) ASSERT_NEAR(norm(v), 1, 4.5e-16);
  }
}

// The edge is a = 1 / sin(2 pi / 5) for unit circumradius: area 5 sqrt(3) a^2, volume 5 (3 + sqrt
// 5)/12 a^3.
TEST(icosphere, without_subdivision_is_the_regular_icosahedron) {
  const double a = 1 / std::sin(2 * pi / 5);
  EXPECT_NEAR(surface_area(icosphere(0)), 5 * std::sqrt(3) * a * a, 1e-14);
  EXPECT_NEAR(enclosed_volume(icosphere(0)), 5 * (3 + std::sqrt(5)) / 12 * a * a * a, 1e-14);
}

TEST(latitude_longitude_sphere, vertices_run_from_the_north_pole_along_rings_to_the_south_pole) {
  const int n_theta = 4, n_phi = 6;
  const Mesh mesh = latitude_longitude_sphere(n_theta, n_phi);
  ASSERT_EQ(mesh.vertices.size(), 26u);
  EXPECT_EQ(mesh.faces.size(), 48u);  // closed, genus 0: 2 (vertices - 2)
  EXPECT_EQ(mesh.vertices.front(), (Vec3{0, 0, 1}));
  EXPECT_EQ(mesh.vertices.back(), (Vec3{0, 0, -1}));
  for (int i = 0; i < n_theta; ++i) {
    for (int j = 0; j < n_phi; ++j) {
      const Vec3& v = mesh.vertices[1 + i * n_phi + j];
      EXPECT_NEAR(std::acos(v.z), pi * (i + 0.5) / n_theta, 1e-15);
      EXPECT_NEAR(std::remainder(std::atan2(v.y, v.x) - 2 * pi * j / n_phi, 2 * pi), 0, 1e-15);
    }
  }
}

TEST(latitude_longitude_sphere, one_ring_of_four_is_the_octahedron) {
  const Mesh mesh = latitude_longitude_sphere(1, 4);
  EXPECT_NEAR(enclosed_volume(mesh), 4.0 / 3, 1e-15);
  EXPECT_NEAR(surface_area(mesh), 4 * std::sqrt(3), 1e-14);
}

TEST(ellipsoid, has_the_volume_of_the_sphere_times_its_axes) {
  EXPECT_NEAR(enclosed_volume(ellipsoid({2, 0.5, 3}, 2)), 3 * enclosed_volume(icosphere(2)), 1e-14);
}

TEST(box, has_the_volume_area_and_counts_of_a_box) {
  for (const int n : {1, 2, 7}) {
    const Mesh mesh = box({1, 2, 3}, n);
    EXPECT_EQ(mesh.faces.size(), 12u * n * n);
    EXPECT_EQ(mesh.vertices.size(), 6u * n * n + 2);
    EXPECT_NEAR(enclosed_volume(mesh), 6, 1e-14);
    EXPECT_NEAR(surface_area(mesh), 22, 1e-13);
    const Bounds corners = bounds(mesh.vertices);
    EXPECT_EQ(corners.min, (Vec3{-0.5, -1, -1.5}));
    EXPECT_EQ(corners.max, (Vec3{0.5, 1, 1.5}));
  }
}

// Between two neighbouring half planes the solid is (rho, z, s) -> rho ((1 - s) e0 + s e1) + z,
// with the Jacobian rho sin(angle). This is Pappus' theorem for polygons.
TEST(torus, has_the_volume_of_its_polygonal_rings) {
  const int n_ring = 9, n_tube = 7;
  const double ring = 2, tube = 0.75;
  const double section = 0.5 * n_tube * tube * tube * std::sin(2 * pi / n_tube);
  EXPECT_NEAR(enclosed_volume(torus(ring, tube, n_ring, n_tube)),
              n_ring * std::sin(2 * pi / n_ring) * ring * section, 1e-13);
}

TEST(bumpy_sphere, stays_within_its_amplitude_and_depends_on_the_seed_alone) {
  const Mesh mesh = bumpy_sphere(3, 0.3, 7);
  double low = 2, high = 0;
  for (const Vec3& v : mesh.vertices) {
    low = std::min(low, norm(v));
    high = std::max(high, norm(v));
  }
  EXPECT_GE(low, 0.7);
  EXPECT_LE(high, 1.3);
  EXPECT_GT(high - low, 0.1);  // there are bumps
  EXPECT_EQ(mesh.vertices, bumpy_sphere(3, 0.3, 7).vertices);
  EXPECT_NE(mesh.vertices, bumpy_sphere(3, 0.3, 8).vertices);
  EXPECT_EQ(bumpy_sphere(2, 0).vertices, icosphere(2).vertices);
}

template <typename Make>
void expect_refused(Make make, const std::string& value) {
  try {
    make();
    FAIL() << "not refused: " << value;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kInvalidInput);
    EXPECT_NE(std::string(error.what()).find(value), std::string::npos) << error.what();
  }
}

TEST(primitives, refuse_sizes_out_of_range_and_name_them) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  expect_refused([] { icosphere(-1); }, "-1");
  expect_refused([] { icosphere(13); }, "13");
  expect_refused([] { latitude_longitude_sphere(0, 8); }, "0 x 8");
  expect_refused([] { latitude_longitude_sphere(4, 2); }, "4 x 2");
  expect_refused([] { latitude_longitude_sphere(2000000000, 2000000000); }, "2000000000");
  expect_refused([] { ellipsoid({1, -2, 1}, 1); }, "-2");
  expect_refused([=] { ellipsoid({1, nan, 1}, 1); }, "nan");
  expect_refused([] { box({0, 1, 1}); }, "0.0");
  expect_refused([=] { box({1, infinity, 1}); }, "inf");
  expect_refused([] { box({1, 1, 1}, 0); }, "is 0");
  expect_refused([] { box({1, 1, 1}, 5000); }, "5000");
  expect_refused([] { torus(1, 1, 8, 8); }, "1.0");
  expect_refused([] { torus(2, 1, 2, 8); }, "2 x 8");
  expect_refused([] { bumpy_sphere(1, 1); }, "1.0");
  expect_refused([=] { bumpy_sphere(1, nan); }, "nan");
}

}  // namespace
}  // namespace rholm
