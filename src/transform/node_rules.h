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
};
struct FaceNode {
  std::array<double, 3> at;  // barycentric
  double weight;             // sum 1
};

// How far an edge or face extends. Along a straight piece, x/|x| bends: derivative p of
// ((1 + is)/(1 - is))^(l/2) at 0, a harmonic along it, is b_p(l) with b_{p+1} = l b_p + p(p-1)
// b_{p-1}, some (l^2 + (0.6 p)^2)^(p/2), within 0.5 ... 1.3 for l >= 4 and up to 20 too large for p
// = 14, l = 1. So for a rule of power p, z^2 = wave2 + (0.6 p)^2 bend2.
struct Extent {
  double wave2 = 0;  // (L theta)^2
  double bend2 = 0;  // (length / distance)^2
};

// Errors of elements add up in squares where each is as long as a wave. Shorter neighbours on a
// smooth surface leave errors of one sign: as many as fit into a wave add up as they are. By this
// factor an element counts more, for a (L theta)^2.
double neighbours_in_step(double wave2);

// The smallest rule for an element of extent z and total weight `weight`; empty if it is better cut
// in halves.
EdgeRule edge_rule(const NodeAllowance& allowance, const Extent& z, double weight);
std::span<const FaceNode> face_rule(const NodeAllowance& allowance, const Extent& z, double weight);

// Error of lumping (VG) per unit of weight and z^4 / L: 1/720 of Hermite's rule, the mean of cos^8
// over directions 35/128, p = 4.
double lumping_error(int degree);

}  // namespace rholm
