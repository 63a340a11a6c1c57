#include "transform/rules/bernstein_rules.h"

#include <algorithm>
#include <cmath>

#include "shape/queries/closest_point.h"

namespace rholm {
namespace {

// Returns ln of 4 M(rho) rho^-p / (rho - 1), or infinity where the ellipse reaches the singular
// set.
double log_error(double rho, int p, double ratio, int degree, Growth growth) {
  const double q = ratio * (rho - 1 / rho) / 2;
  double grown = degree * q;
  if (growth != Growth::kArc) {
    if (q >= 1) return INFINITY;
    grown = degree * std::atanh(q);
    if (growth == Growth::kFlatInverseSquare) grown -= std::log1p(-q * q);
  }
  return std::log(4.0) + grown - p * std::log(rho) - std::log(rho - 1);
}

}  // namespace

double quadrature_error(int exactness, double half_length, double distance, int degree,
                        Growth growth) {
  // Any rule integrates a constant exactly. At degree
  // 0 only the factor 1/|x|^2 causes an error.
  if (degree == 0 && growth != Growth::kFlatInverseSquare) return 0;
  const double ratio = half_length / distance;
  if (!(ratio > 0)) return half_length > 0 ? INFINITY : 0;
  // The minimum of kappa (rho - 1/rho)/2 - p ln rho, kappa = l a / r, is at p/kappa +
  // sqrt((p/kappa)^2 - 1). The singular set moves it down to a point with q < 1.
  const double kappa = std::max(degree, 1) * ratio;
  const double half = exactness / kappa;
  const double best = half > 1 ? half + std::sqrt(half * half - 1) : 1.0;
  double least = INFINITY;
  const auto try_rho = [&](double rho) {
    if (rho > 1) least = std::min(least, log_error(rho, exactness, ratio, degree, growth));
  };
  try_rho(best);
  if (growth != Growth::kArc) {
    for (const double q : {0.25, 0.5, 0.75, 0.9, 0.97}) {
      try_rho(q / ratio + std::sqrt(q * q / (ratio * ratio) + 1));  // rho with this q
    }
  }
  return std::exp(least);
}

int exactness_for(const Allowance& allowance, double half_length, double distance) {
  for (int p = 1; p <= kMaxExactness; ++p) {
    double error = allowance.last *
                   quadrature_error(p, half_length, distance, allowance.degree, allowance.growth);
    if (allowance.first > 0 && allowance.degree > 1) {
      error += allowance.first * quadrature_error(p, half_length, distance, 1, allowance.growth);
    }
    if (error <= allowance.allowed) return p;
  }
  return 0;
}

const GaussRule& segment_rule(int exactness) {
  static const std::vector<GaussRule> rules = [] {
    std::vector<GaussRule> made;
    for (int n = 1; n <= (kMaxExactness + 1) / 2 + 1; ++n) {
      GaussRule rule = gauss_legendre(n);
      for (double& x : rule.nodes) x = (1 - x) / 2;
      for (double& w : rule.weights) w /= 2;
      made.push_back(std::move(rule));
    }
    return made;
  }();
  return rules[static_cast<std::size_t>(exactness) / 2];
}

namespace {

void add_orbit(TriangleRule& rule, double a, double weight) {
  const double b = 1 - 2 * a;
  for (const auto& node : {std::array{b, a, a}, std::array{a, b, a}, std::array{a, a, b}}) {
    rule.nodes.push_back(node);
    rule.weights.push_back(weight);
  }
}

// Returns symmetric rules with positive weights and inner points, in closed form: centroid; the
// three points of degree 2; Strang and Fix 1973 (degree 4, 6 points, closed form by Lyness and
// Jespersen 1975); Radon 1948 (degree 5, 7 points).
TriangleRule make_symmetric_rule(int exactness) {
  TriangleRule rule;
  if (exactness <= 1) {
    rule.nodes.push_back({1.0 / 3, 1.0 / 3, 1.0 / 3});
    rule.weights.push_back(1);
  } else if (exactness == 2) {
    add_orbit(rule, 1.0 / 6, 1.0 / 3);
  } else if (exactness <= 4) {
    const double root = std::sqrt(10.0), inner = std::sqrt(38 - 44 * std::sqrt(0.4));
    const double w = std::sqrt(213125 - 53320 * root);
    add_orbit(rule, (8 - root + inner) / 18, (620 + w) / 3720);
    add_orbit(rule, (8 - root - inner) / 18, (620 - w) / 3720);
  } else {
    const double root = std::sqrt(15.0);
    rule.nodes.push_back({1.0 / 3, 1.0 / 3, 1.0 / 3});
    rule.weights.push_back(9.0 / 40);
    add_orbit(rule, (6 - root) / 21, (155 - root) / 1200);
    add_orbit(rule, (6 + root) / 21, (155 + root) / 1200);
  }
  return rule;
}

}  // namespace

const TriangleRule& symmetric_rule(int exactness) {
  static const std::array<TriangleRule, 6> rules = {make_symmetric_rule(0), make_symmetric_rule(1),
                                                    make_symmetric_rule(2), make_symmetric_rule(3),
                                                    make_symmetric_rule(4), make_symmetric_rule(5)};
  return rules[static_cast<std::size_t>(exactness)];
}

double segment_distance(const Vec3& a, const Vec3& b) {
  return norm(closest_point_of_segment({0, 0, 0}, a, b));
}

double triangle_distance(const std::array<Vec3, 3>& corners) {
  // For small triangles a ball around the centroid is enough.
  const Vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
  double reach = 0;
  for (const Vec3& corner : corners) reach = std::max(reach, norm(corner - middle));
  const double distance = norm(middle);
  if (reach < 0.1 * distance) return distance - reach;
  return norm(closest_point_of_triangle({0, 0, 0}, corners));
}

}  // namespace rholm
