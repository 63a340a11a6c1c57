// Hermite's rules: their degree of exactness, and their errors compared with their constants.
#include "transform/rules/hermite_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "rholm/harmonic.h"

namespace rholm {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

// Sums a function and its derivatives along the edge at 0 and z, and values in between.
template <typename F>
Complex hermite_edge_mean(const HermiteEdge& rule, double z, const F& derivative) {
  Complex sum = rule.value * (derivative(0, 0.0) + derivative(0, z)) +
                rule.gradient * z * (derivative(1, 0.0) - derivative(1, z)) +
                rule.hessian * z * z * (derivative(2, 0.0) + derivative(2, z));
  for (int n = 1; n <= rule.nodes; ++n) {
    sum += rule.node * derivative(0, z * n / (rule.nodes + 1));
  }
  return sum;
}

TEST(hermite_rules, on_edges_are_exact_below_their_power_and_no_further) {
  for (const HermiteEdge& rule : kHermiteEdges) {
    for (int degree = 0; degree <= rule.power; ++degree) {
      const Complex mean = hermite_edge_mean(rule, 1, [&](int order, double x) -> Complex {
        double factor = 1;
        for (int k = 0; k < order; ++k) factor *= degree - k;
        return factor == 0 ? 0 : factor * std::pow(x, degree - order);
      });
      const double error = std::abs(mean - 1.0 / (degree + 1));
      EXPECT_EQ(error < 1e-15, degree < rule.power) << degree << ": " << error;
    }
  }
}

// Plane waves of wave number 1 in all directions, on an edge of length z.
TEST(hermite_rules, on_edges_leave_what_their_constants_say) {
  constexpr int kWaves = 400;
  for (const HermiteEdge& rule : kHermiteEdges) {
    for (const double z : {2.0, 4.0}) {
      double square = 0;
      for (int d = 0; d < kWaves; ++d) {
        const double k = std::cos(2 * kPi * (d + 0.5) / kWaves);
        const Complex mean = hermite_edge_mean(rule, z, [&](int order, double x) {
          return std::pow(Complex(0, k), order) * std::polar(1.0, k * x);
        });
        const Complex exact = (std::polar(1.0, k * z) - 1.0) / Complex(0, k * z);
        square += std::norm(mean - exact) / kWaves;
      }
      const double error = std::sqrt(square) / (rule.constant * std::pow(z, rule.power));
      EXPECT_LT(error, 1.02);  // constants are rounded
      EXPECT_GT(error, 0.6);   // waves are not short compared with the edge
    }
  }
}

// Compares with 28^2 Gauss nodes on an equilateral triangle of edge z.
TEST(hermite_rules, on_faces_leave_no_more_than_their_constants_say) {
  constexpr int kWaves = 60;
  const std::array<std::array<double, 2>, 3> p = {{{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}};
  const GaussRule gauss = gauss_legendre(28);
  for (const HermiteFace& rule : kHermiteFaces) {
    for (const double z : {2.0, 4.0, 7.0}) {
      double square = 0;
      for (int d = 0; d < kWaves; ++d) {
        const double turn = 2 * kPi * (d + 0.3) / kWaves;
        const auto phase = [&](double x, double y) {
          return z * (std::cos(turn) * x + std::sin(turn) * y);
        };
        const auto at = [&](double a, double b, double c) {
          return std::polar(1.0, phase(a * p[0][0] + b * p[1][0] + c * p[2][0],
                                       a * p[0][1] + b * p[1][1] + c * p[2][1]));
        };
        Complex exact = 0, mean = rule.center * at(1.0 / 3, 1.0 / 3, 1.0 / 3);
        for (int i = 0; i < 28; ++i) {
          const double a = (1 + gauss.nodes[i]) / 2;
          for (int k = 0; k < 28; ++k) {
            const double b = (1 - a) * (1 + gauss.nodes[k]) / 2;
            exact += (1 - a) * gauss.weights[i] * gauss.weights[k] / 2 * at(a, b, 1 - a - b);
          }
        }
        for (std::size_t i = 0; i < 3; ++i) {
          const auto &o = p[i], &q = p[(i + 1) % 3], &r = p[(i + 2) % 3];
          const Complex a(0, phase(q[0] - o[0], q[1] - o[1]));
          const Complex b(0, phase(r[0] - o[0], r[1] - o[1]));
          const Complex f = std::polar(1.0, phase(o[0], o[1]));
          mean += f * (rule.value + rule.gradient * (a + b) + rule.square * (a * a + b * b) +
                       rule.product * 2.0 * a * b);
          for (const HermiteOrbit& orbit : rule.orbits) {
            std::array<double, 3> node = {orbit.at, orbit.other, 1 - orbit.at - orbit.other};
            std::rotate(node.begin(), node.begin() + i, node.end());
            mean += orbit.weight * at(node[0], node[1], node[2]);
            if (orbit.nodes() == 6) mean += orbit.weight * at(node[1], node[0], node[2]);
          }
        }
        square += std::norm(mean - exact) / kWaves;
      }
      const double error = std::sqrt(square) / (rule.constant * std::pow(z, rule.power));
      EXPECT_LT(error, 1.02) << rule.power << " " << z;
      EXPECT_GT(error, 0.4) << rule.power << " " << z;
    }
  }
}

}  // namespace
}  // namespace rholm
