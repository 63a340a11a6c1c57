// Error model of quadrature rules for harmonics, which decides the choice of rules.
//
// Locally a harmonic of degree l is a superposition of plane waves of wave number l. A rule on an
// edge or face of extent z = L theta has the error C z^p times its weight. This is a mean over
// directions of waves. Over all degrees, divided by l(l+1), the errors add up to
//   weight C (L theta)^p sqrt(1 / (4 pi (p - 1))) / L                                       (l2).
// This uses that sum (2l+1)/(4 pi) (l/L)^2p / (l(l+1))^2 = 1 / (4 pi (p - 1) L^2).
#pragma once

namespace rholm {

// Allowed error of rules: the l2 norm over the degrees of the error of one edge or face.
struct NodeAllowance {
  int degree = 0;
  double allowed = 0;   // error of one element
  bool divided = true;  // divided by l(l+1); else every degree counts in full
};

// Returns the factor of weight C (L theta)^p in (l2). Undivided, sum (2l+1)/(4 pi) (l/L)^2p = L^2 /
// (4 pi (p + 1)).
double degree_factor(const NodeAllowance& allowance, double p);

// Found on spheres, ellipsoids and bumpy bodies of up to 80 000 faces, L = 1 ... 64;
// adversarial_test checks it.
inline constexpr double kInStep = 1.2;
inline constexpr double kMostInStep = 50;  // chosen: edges seen end on have no extent at all

// Errors of elements add up in squares where each element is as long as a wave. Errors of shorter
// neighbours on a smooth surface have one sign; all that fit into a wave add up linearly. Returns
// the factor for an element of this (L theta)^2.
double neighbours_in_step(double wave2);

// Returns the square of that factor for elements of which `along` and `across` fit into a wave.
// Narrow elements count more, by the number of them that are alike. Around the pole of a lattice,
// in a fan, all are alike, and their errors add up in the waves around the pole. N of them within
// half a wave leave 2 N / sqrt(pi p) times the energy, p the power of their rule (own_nodes_test).
// A ball to degree 16 had three times the estimated error.
double crowd_in_step2(double along, double across);

}  // namespace rholm
