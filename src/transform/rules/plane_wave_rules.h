// Chooses rules for edges and faces by their allowed error, with the model of error_model.h.
#pragma once

#include <array>
#include <span>

#include "transform/rules/error_model.h"

namespace rholm {

struct EdgeRule {
  std::span<const double> nodes, weights;  // on [0, 1]; the weights sum to 1
  double error = 0;                        // error as in NodeAllowance
};
struct FaceNode {
  std::array<double, 3> at;  // barycentric
  double weight;             // the weights sum to 1
};
// The rule of six nodes, exact to degree 4 (Strang and Fix 1973), has two orbits of (at, at, 1 - 2
// at). kSixNodesConstant is its error for plane waves per z^5.
struct SixNodes {
  double weight, at;
};
inline constexpr std::array<SixNodes, 2> kSixNodes = {
    {{0.223381589678011, 0.445948490915965}, {0.109951743655322, 0.091576213509771}}};
inline constexpr double kSixNodesConstant = 7.4e-7;

struct FaceRule {
  std::span<const FaceNode> nodes;
  double error = 0;
};

// Narrow elements, b wide as seen from the centre, lie beside others that are alike. Their errors
// add up linearly in waves across them, all that fit into a wave, as in neighbours_in_step().
// Needles longer than the shortest wave are worse: rows of them add up in all waves that run along
// them, and vanish in all others. Let an element's error go as (k cos psi)^p, k <= L, psi the angle
// between wave and element. Then the energy of M rows b apart is:
//   M (2 pi / b) int_-L^L (k/L)^2p dk,  instead of  M int_{k < L} (k/L)^2p cos^2p psi d^2k.
// This is 2 / (L b <cos^2p>) times as much; <cos^2p> is about 1 / sqrt(pi p).
struct Crowd {
  float per_wave = 0;   // 1 / (L b)
  bool needle = false;  // true if a wave fits along the element
};

// Extent of an edge or face. Along a straight piece, x/|x| bends: a harmonic along it is ((1 +
// is)/(1 - is))^(l/2). Its derivative p at 0 is b_p, b_{p+1} = l b_p + p(p-1) b_{p-1}, about (l^2 +
// (0.6 p)^2)^(p/2). This is within 0.5 ... 1.3 for l >= 4, and up to 20 times too large for p = 14,
// l = 1. So a rule of power p has z^2 = wave2 + (0.6 p)^2 bend2.
struct Extent {
  double wave2 = 0;  // (L theta)^2
  double bend2 = 0;  // (length / distance)^2
  Crowd crowd = {};
};

// Returns the smallest rule for an element of extent z and total weight `weight`, without nodes if
// halves are better. The search begins at the number `likely`, which becomes the rule's number:
// neighbours have the same number, or nearly.
EdgeRule edge_rule(const NodeAllowance& allowance, const Extent& z, double weight, int& likely);
FaceRule face_rule(const NodeAllowance& allowance, const Extent& z, double weight, int& likely);
inline EdgeRule edge_rule(const NodeAllowance& allowance, const Extent& z, double weight) {
  int first = 0;
  return edge_rule(allowance, z, weight, first);
}
inline FaceRule face_rule(const NodeAllowance& allowance, const Extent& z, double weight) {
  int first = 0;
  return face_rule(allowance, z, weight, first);
}

}  // namespace rholm
