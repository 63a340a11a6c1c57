// Quadrature rules: their degree of exactness, and their errors compared with the plan's values.
#include "transform/rules/plane_wave_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "rholm/harmonic.h"

namespace rholm {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

// Returns all rules from the smallest on, as they are chosen while the allowed error falls.
std::vector<EdgeRule> all_edge_rules() {
  std::vector<EdgeRule> rules;
  for (double error = 10; error > 1e-90; error /= 1.2) {
    const EdgeRule rule = edge_rule({.degree = 100, .allowed = error}, {.wave2 = 1}, 1.0);
    if (rule.nodes.empty()) break;
    if (rules.empty() || rules.back().nodes.data() != rule.nodes.data()) rules.push_back(rule);
  }
  return rules;
}
std::vector<std::span<const FaceNode>> all_face_rules() {
  std::vector<std::span<const FaceNode>> rules;
  for (double error = 10; error > 1e-90; error /= 1.2) {
    const auto rule = face_rule({.degree = 100, .allowed = error}, {.wave2 = 1}, 1.0).nodes;
    if (rule.empty()) break;
    if (rules.empty() || rules.back().data() != rule.data()) rules.push_back(rule);
  }
  return rules;
}

// Returns the mean of a^i b^j c^k over a triangle: 2 i! j! k! / (i + j + k + 2)!.
double mean_of_monomial(int i, int j, int k) {
  return 2 * std::exp(std::lgamma(i + 1) + std::lgamma(j + 1) + std::lgamma(k + 1) -
                      std::lgamma(i + j + k + 3));
}

double largest_moment_error(std::span<const FaceNode> rule, int degree) {
  double worst = 0;
  for (int i = 0; i <= degree; ++i) {
    for (int j = 0; i + j <= degree; ++j) {
      const int k = degree - i - j;
      double sum = 0;
      for (const FaceNode& node : rule) {
        sum += node.weight * std::pow(node.at[0], i) * std::pow(node.at[1], j) *
               std::pow(node.at[2], k);
      }
      worst = std::max(worst, std::abs(sum - mean_of_monomial(i, j, k)));
    }
  }
  return worst;
}

TEST(plane_wave_rules, rules_of_n_nodes_on_edges_are_exact_to_degree_2n_minus_1) {
  const auto rules = all_edge_rules();
  ASSERT_EQ(rules.size(), 24u);
  for (std::size_t n = 1; n <= rules.size(); ++n) {
    ASSERT_EQ(rules[n - 1].nodes.size(), n);
    for (int degree = 0; degree < 2 * static_cast<int>(n); ++degree) {
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) {
        sum += rules[n - 1].weights[i] * std::pow(rules[n - 1].nodes[i], degree);
      }
      EXPECT_NEAR(sum, 1.0 / (degree + 1), 2e-15) << n << " " << degree;
    }
  }
}

TEST(plane_wave_rules, rules_on_faces_are_exact_to_their_degree_and_no_further) {
  const auto rules = all_face_rules();
  // Numbers of nodes and degrees: named rules, then n x (n + 1) nodes of degree 2n - 1, n = 7 ...
  // 14.
  const std::vector<std::pair<std::size_t, int>> known = {
      {1, 1}, {3, 2}, {6, 4}, {7, 5}, {12, 6}, {12, 7}, {16, 8}, {19, 9}, {25, 10}, {33, 12}};
  ASSERT_EQ(rules.size(), 18u);
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const std::size_t n = i - 3;
    const auto [nodes, exact] =
        i < known.size() ? known[i] : std::pair(n * (n + 1), 2 * static_cast<int>(n) - 1);
    EXPECT_EQ(rules[i].size(), nodes);
    double sum = 0;
    for (const FaceNode& node : rules[i]) {
      EXPECT_GT(node.weight, 0);
      EXPECT_NEAR(node.at[0] + node.at[1] + node.at[2], 1, 1e-15);
      for (const double a : node.at) EXPECT_GT(a, 0);
      sum += node.weight;
    }
    EXPECT_NEAR(sum, 1, 1e-15);
    // Dunavant's coordinates have 15 digits.
    for (int degree = 0; degree <= exact; ++degree) {
      EXPECT_LT(largest_moment_error(rules[i], degree), 3e-15) << nodes << " " << degree;
    }
    EXPECT_GT(largest_moment_error(rules[i], exact + 1), 1e-3 * std::pow(4.0, -exact)) << nodes;
  }
}

// A face or edge in the plane with longest edge 1, as nodes of its rule and of a practically exact
// rule.
struct Element {
  // Nodes of the rule and, with negative weights, of the exact mean.
  std::vector<double> x, y, weight;
  void add(double px, double py, double w) {
    x.push_back(px);
    y.push_back(py);
    weight.push_back(w);
  }
};
constexpr int kExactNodes = 26;  // exact to 1e-15 for a wave of length z = 20
constexpr int kDirections = 12;

Element edge_element(const EdgeRule& rule) {
  Element element;
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    element.add(rule.nodes[i], 0, rule.weights[i]);
  }
  const GaussRule gauss = gauss_legendre(kExactNodes);
  for (int i = 0; i < kExactNodes; ++i) {
    element.add((1 + gauss.nodes[i]) / 2, 0, -gauss.weights[i] / 2);
  }
  return element;
}

using Corners = std::array<std::array<double, 2>, 3>;
Element face_element(std::span<const FaceNode> rule, const Corners& p) {
  Element element;
  const auto add = [&](double a, double b, double c, double weight) {
    element.add(a * p[0][0] + b * p[1][0] + c * p[2][0], a * p[0][1] + b * p[1][1] + c * p[2][1],
                weight);
  };
  for (const FaceNode& node : rule) add(node.at[0], node.at[1], node.at[2], node.weight);
  const GaussRule gauss = gauss_legendre(kExactNodes);
  for (int i = 0; i < kExactNodes; ++i) {
    for (int k = 0; k < kExactNodes; ++k) {
      // These nodes are collapsed at another corner than the product rules.
      const double s = (1 + gauss.nodes[i]) / 2, v = (1 + gauss.nodes[k]) / 2;
      add(s * (1 - v), 1 - s, s * v, -s * gauss.weights[i] * gauss.weights[k] / 2);
    }
  }
  return element;
}

// Returns the mean over directions of |error|^2 for plane waves of that wave number.
double wave_error2(const Element& element, double wave_number) {
  double sum = 0;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = kPi * (k + 0.5) / kDirections;
    const double c = wave_number * std::cos(angle), s = wave_number * std::sin(angle);
    Complex error = 0;
    for (std::size_t i = 0; i < element.x.size(); ++i) {
      error += element.weight[i] * std::polar(1.0, c * element.x[i] + s * element.y[i]);
    }
    sum += std::norm(error);
  }
  return sum / kDirections;
}

// Returns the l2 error of the coefficients 1 <= l <= L. By the addition theorem, the sum over m of
// error of Y_lm|^2 is (2l + 1)/(4 pi) times the mean over plane waves.
double error_left(const Element& element, double z, int degree, bool divided) {
  double sum = 0;
  for (int l = 1; l <= degree; ++l) {
    const double factor = divided ? 1.0 / (l * (l + 1.0)) : 1.0;
    sum += (2 * l + 1) / (4 * kPi) * factor * factor * wave_error2(element, z * l / degree);
  }
  return std::sqrt(sum);
}

// Rounding of waves, relative to the total weight.
double rounding(int degree, bool divided) { return 1e-16 * (divided ? 1 : degree); }

constexpr int kDegree = 10;
// The constants of faces are for the equilateral triangle, and sums over degrees are replaced by
// integrals. The largest ratio found is 1.62, for a needle. The mean error is a third of the
// allowed error, so that the ratio has no effect.
constexpr double kOtherShapes = 1.7;

TEST(plane_wave_rules, edges_get_rules_that_leave_no_more_than_allowed) {
  for (const bool divided : {true, false}) {
    for (const double z : {0.1, 0.5, 1.0, 3.0, 10.0, 20.0}) {
      for (double error = 0.1; error > 1e-14; error /= 4) {
        const NodeAllowance allowance{.degree = kDegree, .allowed = error, .divided = divided};
        const EdgeRule rule = edge_rule(allowance, {.wave2 = z * z}, -1.0);
        if (rule.nodes.empty()) continue;
        EXPECT_LT(error_left(edge_element(rule), z, kDegree, divided),
                  error + rounding(kDegree, divided))
            << z << " " << error << " " << rule.nodes.size() << " nodes";
      }
    }
  }
}

TEST(plane_wave_rules, faces_of_any_shape_get_rules_that_leave_no_more_than_allowed) {
  const Corners equilateral = {{{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}};
  const Corners right = {{{0.5, 0.5}, {0, 0}, {1, 0}}};
  const Corners needle = {{{1, 0}, {0.97, 0.05}, {0, 0}}};
  const Corners flat = {{{0, 0}, {0.4, -0.02}, {1, 0}}};
  for (const bool divided : {true, false}) {
    for (const Corners& corners : {equilateral, right, needle, flat}) {
      for (const double z : {0.1, 0.5, 1.0, 3.0, 10.0}) {
        for (double error = 0.1; error > 1e-14; error /= 10) {
          const NodeAllowance allowance{.degree = kDegree, .allowed = error, .divided = divided};
          const auto rule = face_rule(allowance, {.wave2 = z * z}, 1.0).nodes;
          if (rule.empty()) continue;
          EXPECT_LT(error_left(face_element(rule, corners), z, kDegree, divided),
                    kOtherShapes * error + rounding(kDegree, divided))
              << z << " " << error << " " << rule.size() << " nodes";
        }
      }
    }
  }
}

}  // namespace
}  // namespace rholm
