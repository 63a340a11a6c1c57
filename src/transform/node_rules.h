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

// The smallest rule for an element of extent z and total weight `weight`; empty if it is better cut
// in halves.
EdgeRule edge_rule(const NodeAllowance& allowance, double z, double weight);
std::span<const FaceNode> face_rule(const NodeAllowance& allowance, double z, double weight);

// Error of lumping (VG) per unit of weight and z^4 / L: 1/720 of Hermite's rule, the mean of cos^8
// over directions 35/128, p = 4.
double lumping_error(int degree);

}  // namespace rholm
