// Coefficients of patches by integrals, compared with closed forms and the transform of whole
// meshes.
#include "paper/patches/cap_integral.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "paper/patches/kd_partition.h"
#include "paper/patches/sphere_delaunay.h"
#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "rholm/primitives.h"
#include "rholm/star.h"
#include "rholm/transform.h"
#include "support/random_data.h"
#include "support/test_points.h"

namespace rholm {
namespace {

const double kPi = std::numbers::pi;

CapFrame unit_frame_at(const Vec3& center, double radius = 1) {
  return {.center = center, .x = {1, 0, 0}, .y = {0, 1, 0}, .z = {0, 0, 1}, .radius = radius};
}

// Returns the part of the unit sphere within `half_angle` of the z axis, as rings of triangles.
Mesh cap_mesh(double half_angle, int rings, int n_phi) {
  Mesh mesh;
  mesh.vertices = {{0, 0, 1}};
  const auto n = static_cast<std::uint32_t>(n_phi);
  for (int i = 1; i <= rings; ++i) {
    const double theta = half_angle * i / rings;
    for (int k = 0; k < n_phi; ++k) {
      const double phi = 2 * kPi * k / n_phi;
      mesh.vertices.push_back(
          {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
    }
  }
  for (std::uint32_t k = 0; k < n; ++k) mesh.faces.push_back({0, 1 + k, 1 + (k + 1) % n});
  for (std::uint32_t i = 1; i < static_cast<std::uint32_t>(rings); ++i) {
    for (std::uint32_t k = 0; k < n; ++k) {
      const std::uint32_t a = 1 + (i - 1) * n + k, b = 1 + (i - 1) * n + (k + 1) % n;
      mesh.faces.push_back({a, a + n, b + n});
      mesh.faces.push_back({a, b + n, b});
    }
  }
  return mesh;
}

// Returns C_l0 of the function that is 1 within `half_angle` of the z axis: the integral of P_l is
// (P_{l-1} - P_{l+1}) / (2l+1).
double cap_indicator(int l, double half_angle) {
  const double x = std::cos(half_angle);
  const double integral = l == 0 ? 1 - x
                                 : (std::legendre(static_cast<unsigned>(l - 1), x) -
                                    std::legendre(static_cast<unsigned>(l + 1), x)) /
                                       (2 * l + 1);
  return 2 * kPi * std::sqrt((2 * l + 1) / (4 * kPi)) * integral;
}

// Returns the largest difference of a coefficient from the indicator of a cap of that angle.
double indicator_error(const Coefficients& made, double half_angle) {
  double largest = 0;
  for (int l = 0; l <= made.degree(); ++l) {
    for (int m = 0; m <= l; ++m) {
      const double c = m == 0 ? cap_indicator(l, half_angle) : 0;
      largest = std::max({largest, std::abs(made.c(l, m) - c), std::abs(made.s(l, m))});
    }
  }
  return largest;
}

TEST(CapIntegral, whole_meshes_have_the_coefficients_of_the_edge_transform) {
  const Mesh mesh = bumpy_sphere(3, 0.3);
  const StarChart chart = make_star_chart(mesh, {.center = {.kind = CenterKind::kNone}});
  const Coefficients whole =
      expand(chart, {.degree = 40, .precision = 1e-11}).expansion.coefficients;
  for (const double radius : {1.0, 1e-120, 1e120}) {
    Mesh scaled = mesh;
    for (Vec3& v : scaled.vertices) v *= radius;
    CapIntegral made =
        cap_integral(unit_frame_at({}, radius), {scaled.vertices, mesh.faces}, {.degree = 40});
    EXPECT_NEAR(made.solid_angle, 4 * kPi, 1e-11);
    for (double& value : made.coefficients.values()) value /= radius;
    EXPECT_LT(test::relative_difference(made.coefficients, whole), 1e-9);
  }
}

TEST(CapIntegral, patches_in_one_frame_add_up_to_the_whole) {
  const Mesh mesh = bumpy_sphere(2, 0.3);
  CapFrame frame = unit_frame_at({0.1, 0, -0.1}, 0.7);
  for (const double dilation : {1.0, 2.5}) {
    frame.dilation = dilation;
    const CapIntegralOptions options{.degree = 30};
    const std::span<const Triangle> all = mesh.faces;
    const Coefficients whole = cap_integral(frame, {mesh.vertices, all}, options).coefficients;
    Coefficients sum(30);
    for (const auto& part : {all.first(77), all.subspan(77)}) {
      const CapIntegral made = cap_integral(frame, {mesh.vertices, part}, options);
      for (std::size_t i = 0; i < sum.values().size(); ++i) {
        sum.values()[i] += made.coefficients.values()[i];
      }
    }
    EXPECT_LT(test::relative_difference(sum, whole), 1e-9);
  }
}

// Chords of angle h lie inside the sphere by up to h^2/8, and chords of the border lie inside the
// circle by the same amount.
TEST(CapIntegral, a_patch_of_a_sphere_tends_to_the_indicator_of_its_cap) {
  double last = 0;
  for (const int n : {32, 64, 128}) {
    const Mesh mesh = cap_mesh(0.6, n / 4, n);
    const CapIntegral made =
        cap_integral(unit_frame_at({}), {mesh.vertices, mesh.faces}, {.degree = 24});
    const double error = indicator_error(made.coefficients, 0.6);
    EXPECT_LT(error, std::pow(2 * kPi / n, 2));
    if (last > 0) {
      EXPECT_NEAR(last / error, 4, 0.4);
    }
    last = error;
  }
}

TEST(CapIntegral, on_the_dilated_sphere_it_is_the_indicator_of_the_opened_cap) {
  const Mesh mesh = cap_mesh(0.3, 32, 128);
  const PatchSphere seen{.sphere = {{}, 1}, .axis = {0, 0, 1}};
  const CapFrame frame = patch_frame(seen, mesh.vertices, 1.4);
  EXPECT_NEAR(frame.dilation, std::tan(0.7) / std::tan(0.15), 1e-12);
  EXPECT_NEAR(frame.support, 2 * std::sin(0.15), 1e-14);
  const CapIntegral made = cap_integral(frame, {mesh.vertices, mesh.faces}, {.degree = 24});
  EXPECT_LT(indicator_error(made.coefficients, 1.4), std::pow(2 * kPi / 128, 2));
  EXPECT_NEAR(made.solid_angle, 2 * kPi * (1 - std::cos(0.3)), 1e-3);
}

// Degree 512 on triangles that are long compared with its waves. A plane at height 1 over the
// square with sides |x| < 1, |y| < 1 has r = 1/cos; there is no closed form of its coefficients. A
// square in 2 triangles and the same square in 800 are the same function.
TEST(CapIntegral, the_triangulation_of_a_flat_patch_does_not_matter) {
  const auto square = [](int n) {
    Mesh mesh;
    const auto m = static_cast<std::uint32_t>(n + 1);
    for (int i = 0; i <= n; ++i) {
      for (int k = 0; k <= n; ++k) mesh.vertices.push_back({2.0 * k / n - 1, 2.0 * i / n - 1, 1});
    }
    for (std::uint32_t i = 0; i + 1 < m; ++i) {
      for (std::uint32_t k = 0; k + 1 < m; ++k) {
        const std::uint32_t a = i * m + k;
        mesh.faces.push_back({a, a + 1, a + m + 1});
        mesh.faces.push_back({a, a + m + 1, a + m});
      }
    }
    return mesh;
  };
  const Mesh coarse = square(1), fine = square(20);
  const CapIntegralOptions options{.degree = kMaxIntegralDegree};
  const CapFrame frame = unit_frame_at({});
  const CapIntegral a = cap_integral(frame, {coarse.vertices, coarse.faces}, options);
  const CapIntegral b = cap_integral(frame, {fine.vertices, fine.faces}, options);
  EXPECT_LT(test::relative_difference(a.coefficients, b.coefficients), 1e-7);
  EXPECT_NEAR(a.solid_angle, 4 * kPi / 6, 1e-13);  // a face of a cube
}

// r - R_0 on the patch equals the zero extension minus R_0 times the indicator of the patch, whose
// integral is its solid angle.
TEST(CapIntegral, the_sphere_as_extension_takes_its_part_off_the_mean) {
  const Mesh mesh = cap_mesh(0.7, 6, 20);
  const CapFrame frame = unit_frame_at({0, 0, -0.4}, 0.5);
  CapIntegralOptions options{.degree = 12};
  const CapIntegral zero = cap_integral(frame, {mesh.vertices, mesh.faces}, options);
  options.extension = CapExtension::kSphere;
  const CapIntegral sphere = cap_integral(frame, {mesh.vertices, mesh.faces}, options);
  const double rest = 0.5 * (4 * kPi - zero.solid_angle) / std::sqrt(4 * kPi);
  EXPECT_NEAR(sphere.coefficients.c(0, 0), zero.coefficients.c(0, 0) + rest, 1e-9);
}

TEST(CapIntegral, a_patch_of_its_own_sphere_vanishes_on_the_sphere) {
  const Mesh mesh = cap_mesh(0.6, 40, 160);
  const CapIntegral made = cap_integral(unit_frame_at({}), {mesh.vertices, mesh.faces},
                                        {.degree = 16, .extension = CapExtension::kSphere});
  EXPECT_NEAR(made.coefficients.c(0, 0), std::sqrt(4 * kPi), 1e-3);
  for (int l = 1; l <= 16; ++l) EXPECT_NEAR(made.coefficients.c(l, 0), 0, 1e-3);
}

// The paper's sequence of steps from points to errors. Inside, the series of the zero extension
// converges; at points on the border of the triangulation it is half the radius.
TEST(CapIntegral, points_of_a_sphere_go_through_partition_triangulation_and_integral) {
  const PointCloud cloud = test::sphere_points(4000);
  const KdPartition made = kd_partition(cloud.points, cloud.normals, {.min_cosine = 0.6});
  double solid_angle = 0;
  for (const KdPatch& patch : made.patches) {
    std::vector<Vec3> points, directions, inner;
    for (std::uint32_t k = patch.begin; k < patch.end; ++k) {
      points.push_back(cloud.points[made.order[k]]);
      directions.push_back(points.back() - patch.seen.sphere.center);
    }
    EXPECT_TRUE(patch.seen.best_fitting);
    EXPECT_NEAR(patch.seen.sphere.radius, 1, 1e-10);
    const std::vector<Triangle> triangles = sphere_delaunay(directions);
    const CapFrame frame = patch_frame(patch.seen, points);
    const CapIntegral integral = cap_integral(frame, {points, triangles}, {.degree = 48});
    solid_angle += integral.solid_angle;
    const CapErrors errors = cap_errors(frame, integral.coefficients, points);
    EXPECT_GT(errors.max, 0.3);
    EXPECT_LT(errors.rms, 0.5);
    std::size_t within = 0;
    for (const double e : errors.along_rays) within += std::abs(e) < 0.1;
    EXPECT_GT(2 * within, points.size());
  }
  // Gaps between patches belong to no patch.
  EXPECT_LT(solid_angle, 4 * kPi);
  EXPECT_GT(solid_angle, 0.8 * 4 * kPi);
}

TEST(CapErrors, are_those_of_the_paper) {
  CapFrame frame = unit_frame_at({1, 2, 3}, 2);
  frame.dilation = 3;
  Coefficients constant(4);
  constant.c(0, 0) = std::sqrt(4 * kPi) * 2;
  const std::vector<Vec3> points = {{1, 2, 6}, {1, 4, 3}, {-3, 2, 3}};  // distances 3, 2 and 4
  const CapErrors errors = cap_errors(frame, constant, points);
  EXPECT_NEAR(errors.along_rays[0], 1, 1e-14);
  EXPECT_NEAR(errors.sum, std::sqrt(5), 1e-14);
  EXPECT_NEAR(errors.rms, std::sqrt(5.0 / 3), 1e-14);
  EXPECT_NEAR(errors.max, 2, 1e-14);
  EXPECT_EQ(cap_errors(frame, constant, {}).rms, 0);
}

TEST(CapIntegral, same_bits_for_one_and_two_threads) {
  const Mesh mesh = bumpy_sphere(4, 0.3);
  const PatchMesh patch{mesh.vertices, mesh.faces};
  const CapFrame frame = unit_frame_at({});
  const auto one = cap_integral(frame, patch, {.degree = 60}, {.threads = 1});
  const auto two = cap_integral(frame, patch, {.degree = 60}, {.threads = 2});
  EXPECT_TRUE(std::equal(one.coefficients.values().begin(), one.coefficients.values().end(),
                         two.coefficients.values().begin()));
}

TEST(CapIntegral, refuses_what_is_not_seen_from_inside) {
  const std::vector<Vec3> points = {{1, 0, 1}, {0, 1, 1}, {-1, -1, 1}, {1, -1, -1}, {0, 0, 0}};
  const CapFrame frame = unit_frame_at({});
  const auto run = [&](const Triangle& t, const CapFrame& seen, int degree = 8) {
    const std::vector<Triangle> triangles = {t};
    return cap_integral(seen, {points, triangles}, {.degree = degree});
  };
  EXPECT_GT(run({0, 1, 2}, frame).solid_angle, 0);
  EXPECT_THROW(run({0, 2, 1}, frame), Error);  // inside out
  EXPECT_THROW(run({0, 1, 9}, frame), Error);  // a point that does not exist
  EXPECT_THROW(run({0, 1, 4}, frame), Error);  // the centre is a corner
  EXPECT_THROW(run({0, 1, 2}, frame, -1), Error);
  EXPECT_THROW(run({0, 1, 2}, frame, kMaxIntegralDegree + 1), Error);
  EXPECT_THROW(run({0, 1, 2}, unit_frame_at({}, 0)), Error);
  EXPECT_EQ(run({0, 0, 1}, frame).solid_angle, 0);
  EXPECT_EQ(cap_integral(frame, {points, {}}, {.degree = 3}).coefficients.degree(), 3);
}

}  // namespace
}  // namespace rholm
