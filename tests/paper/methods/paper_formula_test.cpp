// The formula as printed in the paper, beside the correct one. Between (P29) and (P31) the factor
// kappa = -r sin(theta) / (u . n) is taken out of an integral over phi on which it depends.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "harmonic/legendre/legendre_kernels.h"
#include "paper/methods/curl_integrals.h"
#include "support/oracle.h"
#include "support/test_shapes.h"

namespace rholm {
namespace {

using Complex = std::complex<double>;
using test::chart_about;

// (P20) with (P31), (P34), (P35) for m >= 2, integrated over the edges by dtheta (the printed ds is
// another error, which is not reproduced here):
//   F = Pt sin(theta) / (i m) [ r e^{-i m phi} - kappa (n_x I_1 + n_y I_2) ].
Coefficients printed_formula(const Mesh& mesh, int degree) {
  const GaussRule rule = gauss_legendre(12);
  const std::vector<double> mu = legendre_mu(degree);
  Coefficients sum(degree);
  for (int m = 2; m <= degree; ++m) {
    const LegendreOrder order = legendre_order(m, degree, mu[m]);
    for (const Triangle& t : mesh.faces) {
      const Vec3 n = normalized(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                                      mesh.vertices[t[2]] - mesh.vertices[t[0]]));
      for (int i = 0; i < 3; ++i) {
        const Vec3 a = mesh.vertices[t[i]], e = mesh.vertices[t[(i + 1) % 3]] - a;
        for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
          const Vec3 x = a + (1 + rule.nodes[k]) / 2 * e;
          const double r = norm(x);
          const Vec3 u = x / r;
          const double s = std::hypot(u.x, u.y), phi = std::atan2(u.y, u.x);
          const Complex phase = std::polar(1.0, -m * phi), im(0, m);
          const Complex factor = phase / (1.0 - m * m);
          const Complex I1 = factor * (std::cos(phi) + im * std::sin(phi));
          const Complex I2 = factor * (std::sin(phi) - im * std::cos(phi));
          const double kappa = -r * s / dot(u, n);
          const Complex bracket = r * phase - kappa * (n.x * I1 + n.y * I2);
          const double sin_dtheta = -(e.z - u.z * dot(u, e)) / r * rule.weights[k] / 2;
          const Complex g = sin_dtheta / im * bracket;
          const auto row = legendre_row(order, u.z, s);
          for (int l = m; l <= degree; ++l) {
            sum.c(l, m) += row[l - m] * g.real();
            sum.s(l, m) -= row[l - m] * g.imag();
          }
        }
      }
    }
  }
  return sum;
}

// Returns the l2 error over the orders m >= 2: the printed formula is singular for m = 0 and 1.
double error_of_higher_orders(const Coefficients& a, const Coefficients& b) {
  double difference = 0, size = 0;
  for (int l = 2; l <= b.degree(); ++l) {
    for (int m = 2; m <= l; ++m) {
      difference += std::pow(a.c(l, m) - b.c(l, m), 2) + std::pow(a.s(l, m) - b.s(l, m), 2);
      size += std::pow(b.c(l, m), 2) + std::pow(b.s(l, m), 2);
    }
  }
  return std::sqrt(difference / size);
}

TEST(printed_formula, is_wrong_by_a_part_that_refinement_does_not_reduce) {
  double first = 0;
  for (const int subdivisions : {1, 2, 3}) {
    const StarChart chart = chart_about(test::rotated(bumpy_sphere(subdivisions)), {0, 0, 0});
    const Coefficients expected =
        test::oracle_coefficients(chart.mesh, 12, RadialFunction::kRadius, 16);
    const double printed = error_of_higher_orders(printed_formula(chart.mesh, 12), expected);
    const double right = error_of_higher_orders(
        expand(chart, {.degree = 12, .method = Method::kCurl, .precision = 1e-12})
            .expansion.coefficients,
        expected);
    EXPECT_LT(right, 1e-11);
    EXPECT_GT(printed, 0.2);
    if (subdivisions == 1) first = printed;
    EXPECT_GT(printed, 0.5 * first);
  }
}

// On r = 1 + 0.01 Re Y_42 the formula returns 1.40 times the coefficient; the corrected field,
// 1.00.
TEST(printed_formula, returns_1_40_times_the_coefficient_of_a_single_harmonic) {
  Mesh mesh = icosphere(4);
  Coefficients single(4);
  single.c(4, 2) = 0.01;
  const std::vector<double> values = evaluate(single, mesh.vertices);
  for (std::size_t i = 0; i < values.size(); ++i) mesh.vertices[i] *= 1 + values[i];
  EXPECT_NEAR(printed_formula(mesh, 4).c(4, 2) / 0.01, 1.40, 0.03);
  const Coefficients right =
      expand(chart_about(mesh, {0, 0, 0}), {.degree = 4, .method = Method::kCurl})
          .expansion.coefficients;
  EXPECT_NEAR(right.c(4, 2) / 0.01, 1.0, 0.03);
}

// Compares K_m with quadrature of its definition (M2) in every regime: |C| < rho, C = rho, C > rho,
// rho near 0, psi beyond half a turn, orders to 512.
TEST(curl_integrals, agree_with_quadrature_in_every_regime) {
  const GaussRule rule = gauss_legendre(900);
  const struct {
    double C, rho, psi;
  } cases[] = {{0.1, 0.7, 1.2},        {-0.3, 0.9, 1.1}, {0.5, 0.5, 2.0},
               {0.5, 0.5000001, -1.5}, {0.6, 0.5, 2.5},  {0.9, 0.1, 3.1},
               {0.9, 1e-6, -3},        {0.9, 0.0, 1},    {0.9, 0.3, 3.14159265358979},
               {0.9, 0.3, 3.3},        {0.9, 0.3, -4},   {0.99, 1e-12, 2},
               {0.7, 0.69, 0.01},      {0.7, 0.69, 0},   {0.501, 0.5, 3.0},
               {0.2, 0.8, -1.75}};
  for (const auto& [C, rho, psi] : cases) {
    std::vector<Complex> k(513);
    curl_integrals(C, rho, psi, C + rho * std::cos(psi), k);
    for (const int m : {0, 1, 2, 3, 10, 100, 512}) {
      Complex expected = 0;
      for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double t = psi * (1 + rule.nodes[i]) / 2;
        expected += psi / 2 * rule.weights[i] * std::polar(1.0, -m * t) / (C + rho * std::cos(t));
      }
      EXPECT_LT(std::abs(k[m] - expected), 1e-12 * (1 + std::abs(k[0])))
          << C << " " << rho << " " << psi << " " << m;
    }
  }
}

}  // namespace
}  // namespace rholm
