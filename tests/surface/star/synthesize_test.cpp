#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "rholm/descriptors.h"
#include "rholm/error.h"
#include "rholm/harmonic.h"
#include "rholm/primitives.h"
#include "rholm/rotate.h"
#include "rholm/synthesize.h"
#include "rholm/topology.h"
#include "rholm/transform.h"
#include "support/oracle.h"
#include "support/random_data.h"
#include "transform/transform.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;
const double kY00 = 1 / std::sqrt(4 * kPi);

// r(u) = 1 + 0.2 u_z^2, which has degree 2 exactly.
Expansion bulged_sphere() {
  Expansion e;
  e.coefficients = Coefficients(2);
  // z^2 = 1/3 + (2/3) P_2, P_2 = sqrt(4 pi/5) Y_20.
  e.coefficients.c(0, 0) = (1 + 0.2 / 3) / kY00;
  e.coefficients.c(2, 0) = 0.2 * 2.0 / 3 * std::sqrt(4 * kPi / 5);
  return e;
}

TEST(synthesize, puts_vertices_and_normals_where_the_closed_form_has_them) {
  Expansion e = bulged_sphere();
  e.center = {1, -2, 3};
  const Mesh sphere = latitude_longitude_sphere(12, 20);
  const Mesh mesh = synthesize(e, sphere);
  ASSERT_EQ(mesh.faces, sphere.faces);
  const auto& nx = find_attribute(mesh.attributes, "nx")->values;
  const auto& ny = find_attribute(mesh.attributes, "ny")->values;
  const auto& nz = find_attribute(mesh.attributes, "nz")->values;
  for (std::size_t i = 0; i < sphere.vertices.size(); ++i) {
    const Vec3 u = sphere.vertices[i];
    const double r = 1 + 0.2 * u.z * u.z;
    EXPECT_LT(norm(mesh.vertices[i] - e.center - r * u), 1e-14);
    // The surface is F = |x| - 1 - 0.2 z^2/|x|^2 = 0; its normal is along grad F.
    const Vec3 gradient = u - (0.4 * u.z / r) * (Vec3{0, 0, 1} - u.z * u);
    EXPECT_LT(norm(Vec3{nx[i], ny[i], nz[i]} - normalized(gradient)), 1e-14);
  }
}

TEST(synthesize, gauge_of_an_offset_plane_polyhedron_is_the_reciprocal_surface) {
  Expansion e;
  e.function = RadialFunction::kGauge;
  e.coefficients = Coefficients(1);
  e.coefficients.c(0, 0) = 2 / kY00;
  e.coefficients.c(1, 0) = 0.5 * std::sqrt(4 * kPi / 3);  // q = 2 + z/2
  const Mesh sphere = icosphere(2);
  const Mesh mesh = synthesize(e, sphere);
  const auto& nz = find_attribute(mesh.attributes, "nz")->values;
  for (std::size_t i = 0; i < sphere.vertices.size(); ++i) {
    const Vec3 u = sphere.vertices[i];
    EXPECT_LT(norm(mesh.vertices[i] - u / (2 + u.z / 2)), 1e-14);
    // |x| q(x/|x|) = 2|x| + z/2 = 1 on the surface: normal along 2u + e_z/2.
    EXPECT_NEAR(nz[i], normalized(2.0 * u + Vec3{0, 0, 0.5}).z, 1e-14);
  }
}

TEST(synthesize, several_degrees_in_one_call_are_the_truncated_expansions) {
  Expansion e;
  e.coefficients = test::random_coefficients(9, 1);
  e.coefficients.c(0, 0) = 40;
  const Mesh sphere = icosphere(2);
  const std::array degrees = {4, 0, 9, 50};
  const std::vector<Mesh> meshes = synthesize(e, sphere, degrees);
  ASSERT_EQ(meshes.size(), 4u);
  EXPECT_EQ(meshes[2].vertices, meshes[3].vertices);
  EXPECT_EQ(meshes[2].vertices, synthesize(e, sphere).vertices);
  for (const Vec3& v : meshes[1].vertices) EXPECT_NEAR(norm(v), 40 * kY00, 1e-13);
  Expansion cut = e;
  cut.coefficients = e.coefficients.resized(4);
  EXPECT_EQ(meshes[0].vertices, synthesize(cut, sphere).vertices);
}

TEST(synthesize, refuses_a_gauge_that_is_not_positive_and_negative_degrees) {
  Expansion e;
  e.function = RadialFunction::kGauge;
  e.coefficients = Coefficients(1);
  e.coefficients.c(0, 0) = 1;
  e.coefficients.c(1, 0) = 5;
  EXPECT_THROW(synthesize(e, icosphere(1)), Error);
  const std::array degrees = {-1};
  EXPECT_THROW(synthesize(bulged_sphere(), icosphere(1), degrees), Error);
}

TEST(synthesize, gives_the_same_bits_for_any_number_of_threads) {
  Expansion e;
  e.coefficients = test::random_coefficients(30, 2);
  e.coefficients.c(0, 0) = 100;
  const Mesh one = synthesize(e, icosphere(4), {.threads = 1});
  EXPECT_EQ(one.vertices, synthesize(e, icosphere(4), {.threads = 2}).vertices);
}

TEST(directions_of, keep_connectivity_and_refuse_the_centre) {
  const Mesh mesh = box({2, 4, 6});
  const Mesh sphere = directions_of(mesh, {0.5, 0, 0});
  EXPECT_EQ(sphere.faces, mesh.faces);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    EXPECT_NEAR(norm(sphere.vertices[i]), 1, 1e-15);
    EXPECT_LT(norm(cross(sphere.vertices[i], mesh.vertices[i] - Vec3{0.5, 0, 0})), 1e-14);
  }
  EXPECT_THROW(directions_of(mesh, {1, 2, 3}), Error);
  Mesh huge = mesh;
  for (Vec3& v : huge.vertices) v *= 1e200;
  for (const Vec3& u : directions_of(huge, {0, 0, 0}).vertices) EXPECT_NEAR(norm(u), 1, 1e-15);
}

// r = 1 + b z: V = 4 pi/3 (1 + b^2), V c_z = int (1 + b z)^4 z/4 = 4 pi (b/3 + b^3/5).
TEST(measure, volume_and_centroid_of_a_limacon_are_exact) {
  const double b = 0.4;
  Expansion e;
  e.coefficients = Coefficients(1);
  e.coefficients.c(0, 0) = 1 / kY00;
  e.coefficients.c(1, 0) = b * std::sqrt(4 * kPi / 3);
  e.center = {10, 0, -5};
  const SurfaceMeasures m = measure(e);
  const double volume = 4 * kPi / 3 * (1 + b * b);
  EXPECT_NEAR(m.volume.value(), volume, 1e-13);
  const double z = 4 * kPi * (b / 3 + b * b * b / 5) / volume;
  EXPECT_LT(norm(m.centroid.value() - Vec3{10, 0, -5 + z}), 1e-13);
  // Area by its integral over z: 2 pi int r sqrt(r^2 + r'^2 (1 - z^2)) dz.
  double area = 0;
  const GaussRule rule = gauss_legendre(200);
  for (std::size_t i = 0; i < 200; ++i) {
    const double t = rule.nodes[i], r = 1 + b * t;
    area += rule.weights[i] * 2 * kPi * r * std::sqrt(r * r + b * b * (1 - t * t));
  }
  EXPECT_NEAR(m.area.value(), area, 1e-12);
}

// A sphere about a point off its centre has a radius, and a gauge, of infinite degree.
TEST(measure, sphere_expanded_off_its_centre_keeps_volume_area_and_centroid) {
  const double shift = 0.3;
  constexpr int L = 40;  // the tail falls like shift^l
  const GaussRule rule = gauss_legendre(400);
  for (const RadialFunction function : {RadialFunction::kRadius, RadialFunction::kGauge}) {
    // About (0, 0, shift): r = -shift z + sqrt(1 - shift^2 (1 - z^2)); coefficients are zonal.
    Expansion e;
    e.function = function;
    e.center = {0, 0, shift};
    e.coefficients = Coefficients(L);
    for (std::size_t i = 0; i < 400; ++i) {
      const double z = rule.nodes[i];
      const double r = -shift * z + std::sqrt(1 - shift * shift * (1 - z * z));
      const double f = function == RadialFunction::kRadius ? r : 1 / r;
      for (int l = 0; l <= L; ++l) {
        e.coefficients.c(l, 0) += 2 * kPi * rule.weights[i] * f *
                                  std::sqrt((2 * l + 1) / (4 * kPi)) *
                                  std::legendre(static_cast<unsigned>(l), z);
      }
    }
    const SurfaceMeasures m = measure(e);
    EXPECT_NEAR(m.volume.value(), 4 * kPi / 3, 1e-11);
    EXPECT_NEAR(m.area.value(), 4 * kPi, 1e-11);
    EXPECT_LT(norm(m.centroid.value()), 1e-11);
    EXPECT_NEAR(m.sphericity().value(), 1, 1e-11);
  }
}

// The sphericity of Wadell (1935) has no unit.
TEST(descriptors, of_a_ball_are_the_known_ones_and_grow_by_their_power_of_the_unit) {
  const std::map<std::string, double> known = {
      {"volume", 4 * kPi / 3}, {"area", 4 * kPi}, {"sphericity", 1.0}};
  for (const Descriptor& one : descriptors()) {
    ASSERT_TRUE(known.contains(one.name)) << one.name << " has no known value here";
    for (const double radius : {1.0, 0.25, 10.0}) {
      Expansion ball;
      ball.coefficients = Coefficients(0);
      ball.coefficients.c(0, 0) = radius * std::sqrt(4 * kPi);
      const double expected = known.at(one.name) * std::pow(radius, one.length_power);
      EXPECT_NEAR(one.value(measure(ball)).value(), expected, 1e-12 * expected) << one.name;
    }
    EXPECT_FALSE(one.value({})) << one.name;
  }
}

TEST(measure, sphericity_is_that_of_wadell_whatever_the_scale) {
  Expansion e = bulged_sphere();
  const SurfaceMeasures m = measure(e);
  const double expected =
      std::pow(kPi, 1.0 / 3) * std::pow(6 * m.volume.value(), 2.0 / 3) / m.area.value();
  EXPECT_LT(expected, 0.999);
  for (const double scale : {1.0, 1e-90, 1e90}) {
    Expansion scaled = e;
    for (double& value : scaled.coefficients.values()) value *= scale;
    EXPECT_NEAR(measure(scaled).sphericity().value(), expected, 1e-13);
  }
  EXPECT_EQ((SurfaceMeasures{.volume = 0, .area = 1, .centroid = {}}.sphericity()), 0);
}

// Scales are far from 1; one solid has no mean radius.
TEST(measure, scales_and_refuses_an_expansion_without_mean) {
  for (const double scale : {1e-90, 1e90}) {
    Expansion e = bulged_sphere();
    const double volume = measure(e).volume.value();
    for (double& value : e.coefficients.values()) value *= scale;
    EXPECT_NEAR(measure(e).volume.value() / scale / scale / scale / volume, 1, 1e-13);
  }
  EXPECT_THROW(measure(Expansion{}), Error);
}

// The graph of a signed sum is a surface, but not the surface of the body.
TEST(measure, has_no_figures_of_a_signed_sum) {
  Expansion e = bulged_sphere();
  e.signed_sum = true;
  const SurfaceMeasures m = measure(e);
  EXPECT_FALSE(m.volume || m.area || m.centroid || m.sphericity());
  EXPECT_THROW(inertia(e), Error);
  e.signed_sum = false;
  EXPECT_TRUE(measure(e).volume && measure(e).area && measure(e).centroid);
  EXPECT_NO_THROW(inertia(e));
}

// r = 1 + b z: int r^5/5 z^2 dOmega = 4 pi/5 (1/3 + 10 b^2/5 + 5 b^4/7). The integral without z^2,
// minus this one, has the factor 1 - z^2.
TEST(inertia, of_a_limacon_is_exact) {
  const double b = 0.4, b2 = b * b;
  Expansion e;
  e.coefficients = Coefficients(1);
  e.coefficients.c(0, 0) = 1 / kY00;
  e.coefficients.c(1, 0) = b * std::sqrt(4 * kPi / 3);
  e.center = {10, 0, -5};
  const double volume = 4 * kPi / 3 * (1 + b2);
  const double z = 4 * kPi * (b / 3 + b * b2 / 5) / volume;
  const double square = 4 * kPi / 5 * (1 + 10 * b2 / 3 + b2 * b2);
  const double zz = 4 * kPi / 5 * (1.0 / 3 + 2 * b2 + 5 * b2 * b2 / 7);
  const double along = square - zz;                            // about z
  const double across = square / 2 + zz / 2 - volume * z * z;  // about x and y
  const auto rows = inertia(e);
  EXPECT_LT(norm(rows[0] - Vec3{across, 0, 0}), 1e-13);
  EXPECT_LT(norm(rows[1] - Vec3{0, across, 0}), 1e-13);
  EXPECT_LT(norm(rows[2] - Vec3{0, 0, along}), 1e-13);
}

// High degree is compared with a grid of twice the rings; the axes turn with the surface.
TEST(inertia, is_exact_at_high_degree_and_turns_with_the_surface) {
  Expansion e;
  e.coefficients = test::random_coefficients(120, 3);
  for (double& value : e.coefficients.values()) value *= 0.01;
  e.coefficients.c(0, 0) = 1 / kY00;
  const GaussRule rule = gauss_legendre(610);
  std::vector<double> colatitudes;
  colatitudes.reserve(rule.nodes.size());
  for (const double z : rule.nodes) colatitudes.push_back(std::acos(z));
  const std::vector<double> r = evaluate_rings(e.coefficients, colatitudes, 1220);
  double volume = 0;
  Vec3 first;
  double second[3][3] = {};
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double z = rule.nodes[i / 1220], phi = 2 * kPi * static_cast<double>(i % 1220) / 1220;
    const double s = std::sqrt(1 - z * z), u[] = {s * std::cos(phi), s * std::sin(phi), z};
    const double weight = rule.weights[i / 1220] * 2 * kPi / 1220;
    volume += weight * std::pow(r[i], 3) / 3;
    first += weight * std::pow(r[i], 4) / 4 * Vec3{u[0], u[1], u[2]};
    for (int k = 0; k < 9; ++k) {
      second[k / 3][k % 3] += weight * std::pow(r[i], 5) / 5 * u[k / 3] * u[k % 3];
    }
  }
  const double c[] = {first.x / volume, first.y / volume, first.z / volume};
  const double trace = second[0][0] + second[1][1] + second[2][2] -
                       volume * (c[0] * c[0] + c[1] * c[1] + c[2] * c[2]);
  const auto rows = inertia(e);
  for (int j = 0; j < 3; ++j) {
    const double row[] = {rows[j].x, rows[j].y, rows[j].z};
    for (int k = 0; k < 3; ++k) {
      const double moment = second[j][k] - volume * c[j] * c[k];
      EXPECT_NEAR(row[k], (j == k ? trace : 0) - moment, 1e-12 * trace);
    }
  }
  const Rotation quarter = rotation_about({0, 0, 1}, kPi / 2);  // x to y, y to -x
  const auto turned = inertia(rotate(e, quarter, {}));
  EXPECT_NEAR(turned[0].x, rows[1].y, 1e-12 * trace);
  EXPECT_NEAR(turned[0].y, -rows[0].y, 1e-12 * trace);
  EXPECT_NEAR(turned[1].z, rows[0].z, 1e-12 * trace);
}

TEST(inertia, scales_and_refuses_what_has_none) {
  Expansion e = bulged_sphere();
  const double about_x = inertia(e)[0].x;
  for (double& value : e.coefficients.values()) value *= 1e50;
  EXPECT_NEAR(inertia(e)[0].x / 1e250 / about_x, 1, 1e-13);
  for (double& value : e.coefficients.values()) value *= 1e50;
  EXPECT_THROW(inertia(e), Error);  // 1e500
  EXPECT_THROW(inertia(Expansion{}), Error);
  Expansion field = bulged_sphere();
  field.function = RadialFunction::kOther;
  EXPECT_THROW(inertia(field), Error);
  Expansion inside_out = bulged_sphere();
  inside_out.coefficients.c(0, 0) *= -1;
  EXPECT_THROW(inertia(inside_out), Error);
}

// From a mesh to coefficients and back: the rms difference over directions equals the one of (M7).
// It is measured at 100 points of every face, weighted by solid angle.
TEST(synthesize, misses_the_mesh_by_the_truncation_error_known_from_its_norm) {
  const Mesh mesh = bumpy_sphere(3, 0.2);
  const StarChart chart = make_star_chart(mesh);
  Mesh samples;  // points on the faces, no triangles
  std::vector<double> weights;
  test::visit_oracle_nodes(chart.mesh, 10, [&](const Vec3& x, double solid) {
    samples.vertices.push_back(x);
    weights.push_back(solid);
  });
  const Mesh sphere = directions_of(samples, {0, 0, 0});
  for (const int degree : {2, 4, 8, 16, 32, 64}) {
    const Transform transform =
        expand_by(edge_method, chart, {.degree = degree, .precision = 1e-8}, {});
    Expansion expansion = transform.expansion;
    expansion.center = {0, 0, 0};
    const Mesh surface = synthesize(expansion, sphere);
    double square = 0;
    for (std::size_t i = 0; i < samples.vertices.size(); ++i) {
      const Vec3 difference = surface.vertices[i] - samples.vertices[i];
      square += weights[i] * dot(difference, difference);
    }
    EXPECT_NEAR(std::sqrt(square / (4 * kPi)) / *transform.truncation_rms, 1, 0.01) << degree;
  }
}

}  // namespace
}  // namespace rholm
