#include "transform/rules/plane_wave_rules.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

#include "rholm/harmonic.h"

namespace rholm {
namespace {

constexpr double kBend = 0.6;      // see Extent
constexpr int kMaxEdgeNodes = 24;  // enough for extents up to about 30 at any precision
constexpr int kMaxProductOrder = 14;

// Returns (n!)^4 / ((2n+1) ((2n)!)^3), the constant of z^2n in the remainder of Gauss's rule of n
// nodes on an edge. A further factor is the root mean square of cos^2n over directions: 0.61 for n
// = 1, 0.52 for n = 2, then less.
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

void add_turns(std::vector<FaceNode>& nodes, double weight, double a, double b) {
  const double c = 1 - a - b;
  nodes.push_back({{a, b, c}, weight});
  nodes.push_back({{b, c, a}, weight});
  nodes.push_back({{c, a, b}, weight});
}

// Nodes at the permutations of (a, b, 1 - a - b): three if a = b, else six.
struct Orbit {
  double weight, a, b;
};

// Returns a rule from the weight of its centre, if it has one, and from orbits.
TriangleNodes symmetric(int power, double constant, double center,
                        std::initializer_list<Orbit> orbits) {
  TriangleNodes rule{{}, power, constant};
  if (center > 0) rule.nodes.push_back({{1.0 / 3, 1.0 / 3, 1.0 / 3}, center});
  for (const Orbit& orbit : orbits) {
    add_turns(rule.nodes, orbit.weight, orbit.a, orbit.b);
    if (orbit.a != orbit.b) add_turns(rule.nodes, orbit.weight, orbit.b, orbit.a);
  }
  return rule;
}

// Returns a rule from the turns of (a, b, 1 - a - b) alone.
TriangleNodes turned(int power, double constant, std::initializer_list<Orbit> turns) {
  TriangleNodes rule{{}, power, constant};
  for (const Orbit& turn : turns) add_turns(rule.nodes, turn.weight, turn.a, turn.b);
  return rule;
}

// Returns products of Gauss's rules in collapsed coordinates, exact to degree 2n - 1.
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

// Rules in the order of their numbers of nodes: by Strang and Fix (1973), Radon (1948), Gatermann
// (1988), Dunavant (1985), then products. Their numbers were found anew by Newton's method on the
// moments of invariant polynomials. Error constants (plane_wave_rules_test) were found with plane
// waves in all directions on the equilateral triangle of edge z. Constants of 25 and 33 nodes are
// half as large there, and were found on a needle. Constants of products follow 0.55/n times the
// constant of Gauss's rule.
const std::vector<TriangleNodes>& triangle_rules() {
  static const std::vector<TriangleNodes> rules = [] {
    const auto [near, far] = kSixNodes;
    std::vector<TriangleNodes> all = {
        symmetric(2, 2.1e-2, 1, {}),
        symmetric(3, 2.0e-4, 0, {{1.0 / 3, 1.0 / 6, 1.0 / 6}}),
        symmetric(5, kSixNodesConstant, 0,
                  {{near.weight, near.at, near.at}, {far.weight, far.at, far.at}}),
        symmetric(6, 1.1e-7, 0.225,
                  {{0.12593918054482715, 0.10128650732345634, 0.10128650732345634},
                   {0.13239415278850618, 0.47014206410511509, 0.47014206410511509}}),
        // Two rules have twelve nodes: one is better on short edges, the other on long edges.
        symmetric(7, 3.3e-10, 0,
                  {{0.116786275726379, 0.249286745170910, 0.249286745170910},
                   {0.050844906370207, 0.063089014491502, 0.063089014491502},
                   {0.082851075618374, 0.053145049844817, 0.310352451033784}}),
        turned(8, 9.1e-11,
               {{0.05303405631487250, 0.06751786707391609, 0.06238226509440212},
                {0.05755008556996317, 0.03432430294509715, 0.30472650086816720},
                {0.08776281742889211, 0.62327204949109157, 0.32150249385198182},
                {0.13498637401960555, 0.27771616697639178, 0.51584233435359178}}),
        symmetric(9, 6.8e-13, 0.144315607677787,
                  {{0.095091634267285, 0.459292588292723, 0.459292588292723},
                   {0.103217370534718, 0.170569307751760, 0.170569307751760},
                   {0.032458497623198, 0.050547228317031, 0.050547228317031},
                   {0.027230314174435, 0.008394777409958, 0.263112829634638}}),
        symmetric(10, 4.9e-14, 0.09713579628279884,
                  {{0.03133470022713907, 0.48968251919873763, 0.48968251919873763},
                   {0.02557767565869803, 0.04472951339445271, 0.04472951339445271},
                   {0.07964773892721025, 0.18820353561903273, 0.18820353561903273},
                   {0.07782754100477428, 0.43708959149293664, 0.43708959149293664},
                   {0.04328353937728938, 0.22196298916076570, 0.03683841205473628}}),
        symmetric(11, 9.8e-16, 0.07989450474123971,
                  {{0.00822381869046420, 0.02330886751000019, 0.02330886751000019},
                   {0.07112380223237733, 0.42508621060209057, 0.42508621060209057},
                   {0.03735985623430528, 0.02994603195417089, 0.35874014186443146},
                   {0.04543059229617002, 0.14792562620953444, 0.22376697357697301},
                   {0.03088665688456399, 0.03563255958750348, 0.14329537042686715}}),
        symmetric(13, 1.1e-19, 0,
                  {{0.02848605206887755, 0.10925782765935429, 0.10925782765935429},
                   {0.06254121319590276, 0.27146250701492608, 0.27146250701492608},
                   {0.04991833492806094, 0.44011164865859311, 0.44011164865859311},
                   {0.02426683808145203, 0.48820375094554155, 0.48820375094554155},
                   {0.00793164250997364, 0.02464636343633559, 0.02464636343633559},
                   {0.04322736365941421, 0.11629601967792659, 0.25545422863851735},
                   {0.02178358503860756, 0.02303415635526714, 0.29165567973834096},
                   {0.01508367757651144, 0.02138249025617059, 0.12727971723358937}}),
    };
    for (int n = 7; n <= kMaxProductOrder; ++n) {
      all.push_back({product_nodes(n), 2 * n, 0.6 / n * gauss_constant(n)});
    }
    // The weights are known to 15 digits; they are scaled to sums of exactly 1.
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

// Error of each rule per unit of weight and z^p, for one allowance. Two allowances are kept,
// because mostly the same two follow each other.
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

// Returns z^p of an element, whose bending counts as for derivative p. For long waves this is
// divided by e^u, u = 0.035 z^2 / p up to 2, for the next terms of the remainder. The exponential
// is by its series. Gauss's rule with n = p/2 nodes falls by e^(-0.03 z^2 / n), within a factor of
// 3 for z <= 30 (computed).
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

// Returns the factor for errors of an element that its neighbours have alike.
double crowding(const NodeAllowance& allowance, const Extent& z) {
  if (allowance.degree == 0 || z.crowd.needle) return 1;
  const double along = neighbours_in_step(z.wave2), across = kInStep * z.crowd.per_wave;
  return std::sqrt(crowd_in_step2(along, across));
}

// Returns the factor for rows of needles, whose errors go as z^p.
double in_row(const Extent& z, int p) {
  if (!z.crowd.needle) return 1;
  const double energy = 2 * std::sqrt(std::numbers::pi * p) * z.crowd.per_wave;
  return energy > 1 ? std::min(kMostInStep, std::sqrt(energy)) : 1;
}

}  // namespace

namespace {

// Returns the smallest of n rules whose error, left(k), is at most `allowed`, or n if there is
// none. Each rule has a smaller error than the rule before it, but for one that may have a larger
// error.
template <typename Left>
int smallest_rule(int n, double allowed, int likely, double& error, const Left& left) {
  int k = likely;
  for (error = left(k); !(error <= allowed); error = left(k)) {
    if (++k == n) return n;
  }
  if (k > likely) return k;
  int failed = 0;
  for (int i = k - 1; i >= 0 && failed < 2; --i) {
    const double less = left(i);
    if (less <= allowed) {
      k = i;
      error = less;
      failed = 0;
    } else {
      ++failed;
    }
  }
  return k;
}

}  // namespace

EdgeRule edge_rule(const NodeAllowance& allowance, const Extent& z, double weight, int& likely) {
  const auto& rules = segment_rules();
  const std::vector<double>& factors = factors_for(allowance).edge;
  const double error = std::abs(weight) * crowding(allowance, z);
  EdgeRule rule;
  const int k = smallest_rule(kMaxEdgeNodes, allowance.allowed, likely, rule.error, [&](int i) {
    const int p = 2 * (i + 1);
    return error * factors[i] * extent_power(z, p) * in_row(z, p);
  });
  if (k == kMaxEdgeNodes) return {};
  likely = k;
  rule.nodes = rules[k].nodes;
  rule.weights = rules[k].weights;
  return rule;
}

FaceRule face_rule(const NodeAllowance& allowance, const Extent& z, double weight, int& likely) {
  const auto& rules = triangle_rules();
  const int n = static_cast<int>(rules.size());
  const std::vector<double>& factors = factors_for(allowance).face;
  const double error = std::abs(weight) * crowding(allowance, z);
  FaceRule rule;
  const int k = smallest_rule(n, allowance.allowed, likely, rule.error, [&](int i) {
    return error * factors[i] * extent_power(z, rules[i].power) * in_row(z, rules[i].power);
  });
  if (k == n) return {};
  likely = k;
  rule.nodes = rules[k].nodes;
  return rule;
}

}  // namespace rholm
