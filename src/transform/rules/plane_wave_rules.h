// Node counts for edges and faces from the error they may leave.
//
// Locally a harmonic of degree l is a superposition of plane waves of wave number l. A rule on an
// edge or face of extent z = L theta leaves, in the mean over their directions, the part C z^p of
// its weight; over all degrees, divided by l(l+1), that adds up to
//   weight C (L theta)^p sqrt(1 / (4 pi (p - 1))) / L                                       (l2),
// for sum (2l+1)/(4 pi) (l/L)^2p / (l(l+1))^2 = 1 / (4 pi (p - 1) L^2).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace rholm {

// What rules may leave: l2 norm over the degrees of the error of one edge or face.
struct NodeAllowance {
  int degree = 0;
  double error = 0;     // of one element
  bool divided = true;  // by l(l+1); else every degree counts in full
};

struct EdgeRule {
  std::span<const double> nodes, weights;  // on [0, 1], weights of sum 1
  double error = 0;                        // what it leaves, as NodeAllowance has it
};
struct FaceNode {
  std::array<double, 3> at;  // barycentric
  double weight;             // sum 1
};
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
  double per_wave = 0;  // 1 / (L b)
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

// Errors of elements add up in squares where each is as long as a wave. Shorter neighbours on a
// smooth surface leave errors of one sign: as many as fit into a wave add up as they are. By this
// factor an element counts more, for a (L theta)^2.
double neighbours_in_step(double wave2);

// The smallest rule for an element of extent z and total weight `weight`; without nodes if it is
// better cut in halves.
EdgeRule edge_rule(const NodeAllowance& allowance, const Extent& z, double weight);
FaceRule face_rule(const NodeAllowance& allowance, const Extent& z, double weight);

// Below this d_T / r a triangle is taken out of (M6) and summed by bounded terms (method 3e). Those
// have gradients, whose error in the windows of the fast sums is some 9 L times that of weights
// (bench/window_bench): that much larger the terms of (M6), about r / d_T, may well be.
double grazing_slope(int degree);

// Error of lumping (VG) per unit of weight and z^4 / L: 1/720 of Hermite's rule, the mean of cos^8
// over directions 35/128, p = 4.
double lumping_error(int degree);

// Hermite's rules with values, gradients and Hessians at the ends of an edge or the corners of a
// face (VGH), and nodes between where that does not do. The mean over an edge e from a to b:
//   value (f(a) + f(b)) + gradient e . (f'(a) - f'(b)) + hessian ee : (f''(a) + f''(b)) + nodes,
// exact to degree 5, 7, 9 with none, one, two nodes: the weights solve the moment equations, the
// constants are those of the remainder term times the root mean square of cos^p over directions.
struct HermiteEdge {
  double value, gradient, hessian;
  int nodes;        // evenly spaced between the ends
  double node;      // the weight of each
  double constant;  // see the top: C z^p
  int power;
};
inline constexpr int kHermiteRules = 3;
inline constexpr std::array<HermiteEdge, kHermiteRules> kHermiteEdges = {{
    {1.0 / 2, 1.0 / 10, 1.0 / 120, 0, 0, 4.71e-6, 6},
    {19.0 / 70, 1.0 / 35, 1.0 / 840, 1, 16.0 / 35, 2.18e-9, 8},
    {391.0 / 2240, 13.0 / 1120, 1.0 / 3360, 2, 729.0 / 2240, 9.28e-13, 10},
}};

// The mean over a face, a and b the edges that leave a corner:
//   sum over corners of value f + gradient (a + b) . f' + square (aa + bb) : f''
//     + product (ab + ba) : f''  and of orbit f((5 p_i + 5 p_j + p_k) / 11),  + center f(centroid),
// exact to degree 4, 5, 6 with none, one, four nodes; constants found with plane waves as those
// of the other rules, the largest for z = 1 ... 8.
struct HermiteFace {
  double value, gradient, square, product;
  double center, orbit;
  double constant;
  int power;
};
inline constexpr std::array<HermiteFace, kHermiteRules> kHermiteFaces = {{
    {1.0 / 3, 1.0 / 20, 1.0 / 360, 1.0 / 360, 0, 0, 2.7e-5, 5},
    {43.0 / 210, 1.0 / 42, 1.0 / 630, 1.0 / 2520, 27.0 / 70, 0, 1.8e-6, 6},
    {2393.0 / 22500, 19.0 / 2250, 1.0 / 3600, 1.0 / 5600, 1377.0 / 8960,
     (1 - 2393.0 / 7500 - 1377.0 / 8960) / 3, 9.6e-9, 7},
}};
inline constexpr double kHermiteOrbit = 5.0 / 11;

// z^2 of an edge for these rules: p^2 of the bending (see Extent), as for VG, of p = 8.
inline constexpr double kHermiteBend = 25;

// C z^p of each rule in units of lumping_error(L): the l2 factors differ by sqrt(1 / (p - 1)).
inline constexpr double kLumpingConstant = 0.522912 / 720;  // sqrt(35/128) / 720
constexpr double square_root(double x) {
  double root = 1;
  for (int k = 0; k < 50; ++k) root = (root + x / root) / 2;
  return root;
}
template <typename Rule>
constexpr std::array<double, kHermiteRules> hermite_units(
    const std::array<Rule, kHermiteRules>& rules) {
  std::array<double, kHermiteRules> units = {};
  for (std::size_t k = 0; k < units.size(); ++k) {
    units[k] = rules[k].constant / kLumpingConstant * square_root(3.0 / (rules[k].power - 1));
  }
  return units;
}
inline constexpr auto kHermiteEdgeUnits = hermite_units(kHermiteEdges);
inline constexpr auto kHermiteFaceUnits = hermite_units(kHermiteFaces);

// The number of the cheapest rule for an extent: those reach to z^2 = reach2[k], the last to any.
using HermiteReach = std::array<double, kHermiteRules - 1>;
// Up to where each rule leaves at most `error` of its weight, in units of lumping_error(L).
HermiteReach hermite_edge_reach(double error);
HermiteReach hermite_face_reach(double error);
inline std::size_t hermite_rule(const HermiteReach& reach2, double z2) {
  std::size_t k = 0;
  for (const double limit : reach2) k += z2 > limit;
  return k;
}

}  // namespace rholm
