// What rules of nodes leave of harmonics: the model that the rules rest on.
//
// Locally a harmonic of degree l is a superposition of plane waves of wave number l. A rule on an
// edge or face of extent z = L theta leaves, in the mean over their directions, the part C z^p of
// its weight; over all degrees, divided by l(l+1), that adds up to
//   weight C (L theta)^p sqrt(1 / (4 pi (p - 1))) / L                                       (l2),
// for sum (2l+1)/(4 pi) (l/L)^2p / (l(l+1))^2 = 1 / (4 pi (p - 1) L^2).
#pragma once

namespace rholm {

// What rules may leave: l2 norm over the degrees of the error of one edge or face.
struct NodeAllowance {
  int degree = 0;
  double allowed = 0;   // of one element
  bool divided = true;  // by l(l+1); else every degree counts in full
};

// The factor of weight C (L theta)^p in (l2); undivided, sum (2l+1)/(4 pi) (l/L)^2p =
// L^2 / (4 pi (p + 1)).
double degree_factor(const NodeAllowance& allowance, double p);

// On spheres, ellipsoids and bumpy bodies of up to 80 000 faces, L = 1 ... 64; adversarial_test
// judges.
inline constexpr double kInStep = 1.2;
inline constexpr double kMostInStep = 50;  // chosen: edges seen end on have no extent at all

// Errors of elements add up in squares where each is as long as a wave. Shorter neighbours on a
// smooth surface leave errors of one sign: as many as fit into a wave add up as they are. By this
// factor an element counts more, for a (L theta)^2.
double neighbours_in_step(double wave2);

// The square of that factor for elements of which so many fit into a wave along them and across: of
// narrow ones as many more as are alike. Around the pole of a lattice, in a fan, all are, and their
// errors add up in the waves around it: N of them within half a wave leave 2 N / sqrt(pi p) times
// the energy, p the power of their rule (own_nodes_test; a ball to degree 16 left three times what
// it was said to).
double crowd_in_step2(double along, double across);

}  // namespace rholm
