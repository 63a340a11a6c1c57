#include "transform/rules/plane_wave_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "rholm/harmonic.h"

namespace rholm {
namespace {

constexpr double kBend = 0.6;      // see Extent
constexpr int kMaxEdgeNodes = 24;  // pieces of extent up to about 30 at any precision
constexpr int kMaxProductOrder = 14;

// Gauss's rule of n nodes on an edge: (n!)^4 / ((2n+1) ((2n)!)^3) z^2n (remainder term), times the
// root mean square of cos^2n over directions: 0.61 for n = 1, 0.52 for n = 2, then less.
double gauss_constant(int n) {
  double c = 1;
  for (int k = 1; k <= n; ++k) {
    const double twice = 2.0 * k * (2 * k - 1);
    c *= std::pow(k, 4) / (twice * twice * twice);
  }
  return c / (2 * n + 1);
}

struct SegmentRule {
  std::vector<double> nodes, weights;
  double constant;
};

const std::vector<SegmentRule>& segment_rules() {
  static const std::vector<SegmentRule> rules = [] {
    std::vector<SegmentRule> all;
    for (int n = 1; n <= kMaxEdgeNodes; ++n) {
      SegmentRule rule{
          .nodes = {}, .weights = {}, .constant = (n == 1 ? 0.62 : 0.53) * gauss_constant(n)};
      const GaussRule gauss = gauss_legendre(n);
      for (int i = 0; i < n; ++i) {
        rule.nodes.push_back((1 + gauss.nodes[i]) / 2);
        rule.weights.push_back(gauss.weights[i] / 2);
      }
      all.push_back(std::move(rule));
    }
    return all;
  }();
  return rules;
}

struct TriangleNodes {
  std::vector<FaceNode> nodes;
  int power;
  double constant;
};

void add_center(std::vector<FaceNode>& nodes, double weight) {
  nodes.push_back({{1.0 / 3, 1.0 / 3, 1.0 / 3}, weight});
}

// All permutations of (a, b, 1 - a - b): three if a = b, else six.
void add_orbit(std::vector<FaceNode>& nodes, double weight, double a, double b) {
  const double c = 1 - a - b;
  nodes.push_back({{a, b, c}, weight});
  nodes.push_back({{b, c, a}, weight});
  nodes.push_back({{c, a, b}, weight});
  if (a == b) return;
  nodes.push_back({{b, a, c}, weight});
  nodes.push_back({{a, c, b}, weight});
  nodes.push_back({{c, b, a}, weight});
}

// Products of Gauss's rules in collapsed coordinates, exact to degree 2n - 1.
std::vector<FaceNode> product_nodes(int n) {
  const GaussRule across = gauss_legendre(n), along = gauss_legendre(n + 1);
  std::vector<FaceNode> nodes;
  for (int i = 0; i <= n; ++i) {
    const double a = (1 + along.nodes[i]) / 2;
    for (int k = 0; k < n; ++k) {
      const double t = (1 + across.nodes[k]) / 2;
      nodes.push_back({{a, (1 - a) * (1 - t), (1 - a) * t},
                       (1 - a) * along.weights[i] * across.weights[k] / 2});
    }
  }
  return nodes;
}

// Symmetric rules of Strang and Fix (1973) and Dunavant (1985), then products. The constants of the
// error (plane_wave_rules_test) were found with plane waves in all directions on the equilateral
// triangle of edge z; those of products follow 0.55/n times that of Gauss's rule.
const std::vector<TriangleNodes>& triangle_rules() {
  static const std::vector<TriangleNodes> rules = [] {
    std::vector<TriangleNodes> all(5);
    add_center(all[0].nodes, 1);
    all[0].power = 2, all[0].constant = 2.1e-2;
    add_orbit(all[1].nodes, 1.0 / 3, 1.0 / 6, 1.0 / 6);
    all[1].power = 3, all[1].constant = 2.0e-4;
    add_orbit(all[2].nodes, 0.223381589678011, 0.445948490915965, 0.445948490915965);
    add_orbit(all[2].nodes, 0.109951743655322, 0.091576213509771, 0.091576213509771);
    all[2].power = 5, all[2].constant = 7.4e-7;
    add_orbit(all[3].nodes, 0.116786275726379, 0.249286745170910, 0.249286745170910);
    add_orbit(all[3].nodes, 0.050844906370207, 0.063089014491502, 0.063089014491502);
    add_orbit(all[3].nodes, 0.082851075618374, 0.053145049844817, 0.310352451033784);
    all[3].power = 7, all[3].constant = 3.3e-10;
    add_center(all[4].nodes, 0.144315607677787);
    add_orbit(all[4].nodes, 0.095091634267285, 0.459292588292723, 0.459292588292723);
    add_orbit(all[4].nodes, 0.103217370534718, 0.170569307751760, 0.170569307751760);
    add_orbit(all[4].nodes, 0.032458497623198, 0.050547228317031, 0.050547228317031);
    add_orbit(all[4].nodes, 0.027230314174435, 0.008394777409958, 0.263112829634638);
    all[4].power = 9, all[4].constant = 6.8e-13;
    for (int n = 5; n <= kMaxProductOrder; ++n) {
      all.push_back({product_nodes(n), 2 * n, 0.6 / n * gauss_constant(n)});
    }
    // Weights known to 15 digits: sums of exactly 1.
    for (TriangleNodes& rule : all) {
      double sum = 0;
      for (const FaceNode& node : rule.nodes) sum += node.weight;
      for (FaceNode& node : rule.nodes) node.weight /= sum;
    }
    return all;
  }();
  return rules;
}

}  // namespace

namespace {

// What each rule leaves per unit of weight and z^p, for one allowance after the other: mostly the
// same two.
struct Factors {
  NodeAllowance of = {.degree = -1};
  std::vector<double> edge, face;
};

const Factors& factors_for(const NodeAllowance& allowance) {
  thread_local std::array<Factors, 2> kept;
  Factors& factors = kept[allowance.divided];
  if (factors.of.degree == allowance.degree) return factors;
  factors = {.of = allowance, .edge = {}, .face = {}};
  int n = 1;
  for (const SegmentRule& rule : segment_rules()) {
    factors.edge.push_back(rule.constant * degree_factor(allowance, 2.0 * n));
    ++n;
  }
  for (const TriangleNodes& rule : triangle_rules()) {
    factors.face.push_back(rule.constant * degree_factor(allowance, rule.power));
  }
  return factors;
}

// z^p of an element whose bending counts as it does for derivative p, less what the remainder's
// next terms take off long waves: e^(-0.03 z^2 / n) of Gauss's rule with n = p/2 nodes, within a
// factor of 3 for z <= 30 (computed), the exponential by its series.
double extent_power(const Extent& z, int p) {
  double square = z.wave2 + kBend * kBend * (p * p) * z.bend2;
  double result = p % 2 == 0 ? 1 : std::sqrt(square);
  for (int rest = p / 2; rest > 0; rest /= 2) {
    if (rest % 2 != 0) result *= square;
    square *= square;
  }
  if (p < 8) return result;
  const double u = std::min(2.0, 0.035 / p * z.wave2);
  return result / (1 + u * (1 + u / 2 * (1 + u / 3)));
}

}  // namespace

namespace {

// By how much more the errors of an element count for its neighbours.
double crowding(const NodeAllowance& allowance, const Extent& z) {
  if (allowance.degree == 0 || z.crowd.needle) return 1;
  const double along = neighbours_in_step(z.wave2), across = kInStep * z.crowd.per_wave;
  return across > along ? std::min(kMostInStep, std::sqrt(along * across)) : along;
}

// Those of needles that go as z^p.
double in_row(const Extent& z, int p) {
  if (!z.crowd.needle) return 1;
  const double energy = 2 * std::sqrt(std::numbers::pi * p) * z.crowd.per_wave;
  return energy > 1 ? std::min(kMostInStep, std::sqrt(energy)) : 1;
}

}  // namespace

EdgeRule edge_rule(const NodeAllowance& allowance, const Extent& z, double weight) {
  const auto& rules = segment_rules();
  const std::vector<double>& factors = factors_for(allowance).edge;
  const double error = std::abs(weight) * crowding(allowance, z);
  for (std::size_t k = 0; k < rules.size(); ++k) {
    const int p = 2 * static_cast<int>(k + 1);
    const double left = error * factors[k] * extent_power(z, p) * in_row(z, p);
    if (left <= allowance.allowed) return {rules[k].nodes, rules[k].weights, left};
  }
  return {};
}

FaceRule face_rule(const NodeAllowance& allowance, const Extent& z, double weight) {
  const auto& rules = triangle_rules();
  const std::vector<double>& factors = factors_for(allowance).face;
  const double error = std::abs(weight) * crowding(allowance, z);
  for (std::size_t k = 0; k < rules.size(); ++k) {
    const double left =
        error * factors[k] * extent_power(z, rules[k].power) * in_row(z, rules[k].power);
    if (left <= allowance.allowed) return {rules[k].nodes, left};
  }
  return {};
}

}  // namespace rholm
