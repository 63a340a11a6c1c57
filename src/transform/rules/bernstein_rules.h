// Quadrature on segments and triangles for functions Y(x/|x|), with the number of nodes that the
// wanted error needs.
//
// Error bound. Along a straight line a harmonic of degree l continues to complex x. On the
// Bernstein ellipse of parameter rho around a segment of half length a it grows at most like:
//   M(rho) = exp(l artanh(q)),   q = a (rho - 1/rho) / (2 r).
// Here r is the smallest distance from the segment to the singular set (the centre; for the curl
// method the z axis). On an arc of half angle a the growth is exp(l a (rho - 1/rho) / 2). Then a
// rule with positive weights that is exact to polynomial degree p has a mean with an error of at
// most:
//   E(p) = min over rho of 4 M(rho) rho^-p / (rho - 1)
// (Trefethen, Approximation Theory and Approximation Practice, theorems 8.2 and 19.3). Integrands
// with 1/|x|^2 have the further factor 1/(1-q^2). Triangles use half the longest edge: a harmonic
// is locally a superposition of plane waves, functions of one variable each.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "rholm/harmonic.h"
#include "rholm/vec3.h"

namespace rholm {

enum class Growth {
  kFlat,               // Y(x/|x|) on a flat edge or face
  kFlatInverseSquare,  // Y(x/|x|) / |x|^2
  kArc                 // Y on a great circle, parametrised by angle; r = 1
};

// Returns E(p) for degree l, half length a and distance r.
double quadrature_error(int exactness, double half_length, double distance, int degree,
                        Growth growth);

// The error that an integral is allowed to have. Its error is taken as
//   first * E(p; l = 1) + last * E(p; l = L).
// The weights describe how errors of a low degree and of the highest degree enter the result.
struct Allowance {
  double allowed = 0;
  double first = 1;
  double last = 1;
  int degree = 0;
  Growth growth = Growth::kFlat;
};
// Returns the smallest exactness that keeps the allowance, or 0 if none up to kMaxExactness does.
// The piece must then be halved.
inline constexpr int kMaxExactness = 199;  // chosen: rules of at most 101 points a side
int exactness_for(const Allowance& allowance, double half_length, double distance);

// Returns nodes and weights on [0, 1], exact to degree p: Gauss-Legendre. The weights sum to 1.
const GaussRule& segment_rule(int exactness);

// Calls visit(a, b, c, weight) for the nodes of a rule on a triangle, exact to degree p. The nodes
// are barycentric; the weights sum to 1. Rules are symmetric for p <= 5. Others are products of
// Gauss rules in collapsed coordinates x = a p0 + (1-a)((1-t) p1 + t p2), dS = 2 |T| (1-a) da dt,
// with one degree more in a.
struct TriangleRule {
  std::vector<std::array<double, 3>> nodes;
  std::vector<double> weights;
};
const TriangleRule& symmetric_rule(int exactness);  // p <= 5

template <typename Visit>
void visit_triangle_rule(int exactness, const Visit& visit) {
  if (exactness <= 5) {
    const TriangleRule& rule = symmetric_rule(exactness);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      visit(rule.nodes[i][0], rule.nodes[i][1], rule.nodes[i][2], rule.weights[i]);
    }
    return;
  }
  const GaussRule& along = segment_rule(exactness + 1);
  const GaussRule& across = segment_rule(exactness);
  for (std::size_t i = 0; i < along.nodes.size(); ++i) {
    for (std::size_t k = 0; k < across.nodes.size(); ++k) {
      const double a = along.nodes[i], t = across.nodes[k];
      visit(a, (1 - a) * (1 - t), (1 - a) * t, 2 * (1 - a) * along.weights[i] * across.weights[k]);
    }
  }
}

// Return the smallest distance from the origin to a segment, and to a triangle.
double segment_distance(const Vec3& a, const Vec3& b);
double triangle_distance(const std::array<Vec3, 3>& corners);

}  // namespace rholm
