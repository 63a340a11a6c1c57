#include "transform/mesh_pass/own_nodes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "harmonic/coefficients/laplacian.h"
#include "harmonic/legendre/direct_sums.h"
#include "rholm/mesh_view.h"
#include "rholm/primitives.h"

namespace rholm {
namespace {

// Returns int r dOmega of an equilateral triangle at the height d above its middle. In polar
// coordinates of its plane, d int dS / (rho^2 + d^2) is six times
// `d/2 int_0^(pi/3) ln(1 + h^2 / (d cos phi)^2) dphi`. h is the radius of the inscribed circle. The
// function is smooth: Simpson's rule is used.
double radius_integral_above_the_middle(double d, double h) {
  constexpr int kSteps = 1000;
  double sum = 0;
  for (int k = 0; k <= kSteps; ++k) {
    const double cosine = std::cos(std::numbers::pi / 3 * k / kSteps);
    const double weight = k == 0 || k == kSteps ? 1 : k % 2 == 0 ? 2 : 4;
    sum += weight * std::log1p(std::pow(h / (d * cosine), 2));
  }
  return 3 * d * sum * std::numbers::pi / 3 / kSteps / 3;
}

// In flat meshes, planes miss the centre by rounding only.
TEST(radius_integral, keeps_its_relative_error_at_any_height_above_the_triangle) {
  const double h = 0.5;
  for (const double d : {1.0, 1e-2, 1e-5, 1e-8, 1e-11, 1e-13}) {
    const std::array<Vec3, 3> corners = {
        {{1, 0, d}, {-0.5, std::sqrt(0.75), d}, {-0.5, -std::sqrt(0.75), d}}};
    for (const double error : {1e-4, 1e-8, 1e-11}) {
      const double expected = radius_integral_above_the_middle(d, h);
      EXPECT_NEAR(radius_integral(corners, error) / expected, 1, error + 1e-12) << d;
    }
  }
}

// The computed solid angle may be zero where the height is not: a part of zero would allow no
// error.
TEST(radius_integral, of_triangles_whose_planes_miss_the_centre_by_rounding_is_that_small) {
  for (int k = 0; k < 300; ++k) {
    const double a = 0.1 * k, b = 0.37 * k;
    const Vec3 u = {std::cos(a), std::sin(a), 0};
    const Vec3 v = {-std::sin(a) * std::cos(b), std::cos(a) * std::cos(b), std::sin(b)};
    // The triangle's size is half of its distance, which is at least 1.
    const std::array<Vec3, 3> corners = {u, 1.5 * u, 1.2 * u + 0.5 * v};
    EXPECT_LT(std::abs(radius_integral(corners, 1e-14)), 1e-16) << k;
  }
}

class Collected : public NodeSink {
 public:
  std::vector<Vec3> directions;
  std::vector<double> weights;

  void add(std::span<const Node> nodes) override {
    for (const Node& node : nodes) {
      directions.push_back(normalized(node.x));
      weights.push_back(node.weight);
    }
  }
  void add_gradient(const GradientNode&) override { FAIL(); }
  void add_undivided(const Vec3&, double) override { FAIL(); }
};

struct Written {
  Coefficients sum;  // without the constant
  double said = 0;
};
// Writes the cap of a lattice around its pole, by direct sums.
Written write_cap(const Mesh& mesh, int degree, double allowed) {
  Collected nodes;
  const MeshView view = view_of(mesh);
  NodeWriter writer(
      {.divided = {.degree = degree, .allowed = allowed, .divided = true}, .rounding = allowed},
      {.mesh = view, .center = {}, .scale = 1}, nodes);
  for (const Triangle& t : mesh.faces) {
    const std::array<Vec3, 3> p = {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    if (p[0].z + p[1].z + p[2].z > 3 * 0.93) writer.add_triangle(p, t);
  }
  writer.flush();
  Coefficients sum(degree);
  direct_add_adjoint({.directions = nodes.directions, .weights = nodes.weights}, sum, {});
  sum.c(0, 0) = 0;
  divide_by_eigenvalue(sum);
  return {sum, std::sqrt(writer.error2())};
}

// All edges and faces of a row are alike, and long compared with their row.
TEST(node_writer, says_what_its_rules_leave_around_the_pole_of_a_lattice) {
  const Mesh mesh = latitude_longitude_sphere(80, 160);
  constexpr int kDegree = 16;
  const Written exact = write_cap(mesh, kDegree, 1e-17);
  for (const double allowed : {1e-10, 1e-12, 3e-13, 1.5e-13}) {
    const Written found = write_cap(mesh, kDegree, allowed);
    double error2 = 0;
    for (std::size_t i = 0; i < exact.sum.values().size(); ++i) {
      error2 += std::pow(found.sum.values()[i] - exact.sum.values()[i], 2);
    }
    EXPECT_LT(std::sqrt(error2), 2 * found.said) << allowed;
    EXPECT_LT(found.said, 20 * std::sqrt(error2)) << allowed;
  }
}

}  // namespace
}  // namespace rholm
