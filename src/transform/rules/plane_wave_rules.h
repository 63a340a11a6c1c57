// Node counts for edges and faces from the error they may leave, by the model of error_model.h.
#pragma once

#include <array>
#include <span>

#include "transform/rules/error_model.h"

namespace rholm {

struct EdgeRule {
  std::span<const double> nodes, weights;  // on [0, 1], weights of sum 1
  double error = 0;                        // what it leaves, as NodeAllowance has it
};
struct FaceNode {
  std::array<double, 3> at;  // barycentric
  double weight;             // sum 1
};
// Of the rule of six nodes, exact to degree 4 (Strang and Fix 1973): two orbits of
// (at, at, 1 - 2 at), and what the rule leaves of plane waves per z^5.
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

// Side by side with elements that are narrow, b wide as seen from the centre, lie others that are
// alike, and what they leave adds up as it is in waves across them: as many as fit into a wave, as
// neighbours_in_step() has it. Needles longer than the shortest wave are worse: rows of them add up
// in all waves that run along them, and vanish in all others. For elements whose error goes as
// (k cos psi)^p, k <= L, psi the angle between wave and element, and M rows b apart, the energy is
//   M (2 pi / b) int_-L^L (k/L)^2p dk,  instead of  M int_{k < L} (k/L)^2p cos^2p psi d^2k,
// that is 2 / (L b <cos^2p>) times as much, <cos^2p> about 1 / sqrt(pi p).
struct Crowd {
  float per_wave = 0;   // 1 / (L b)
  bool needle = false;  // a wave fits along
};

// How far an edge or face extends. Along a straight piece, x/|x| bends: derivative p of
// ((1 + is)/(1 - is))^(l/2) at 0, a harmonic along it, is b_p(l) with b_{p+1} = l b_p + p(p-1)
// b_{p-1}, some (l^2 + (0.6 p)^2)^(p/2), within 0.5 ... 1.3 for l >= 4 and up to 20 too large for p
// = 14, l = 1. So for a rule of power p, z^2 = wave2 + (0.6 p)^2 bend2.
struct Extent {
  double wave2 = 0;  // (L theta)^2
  double bend2 = 0;  // (length / distance)^2
  Crowd crowd = {};
};

// The smallest rule for an element of extent z and total weight `weight`; without nodes if it is
// better cut in halves. Looked for from the number `likely` on, which becomes that of the rule:
// neighbours have the same, or nearly.
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
