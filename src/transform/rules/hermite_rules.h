// Hermite's rules, which lump edges and faces at their vertices: with gradients (VG), with Hessians
// as well (VGH), and what they leave by the model of error_model.h.
#pragma once

#include <array>
#include <cstddef>

namespace rholm {

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
  double constant;  // see error_model.h: C z^p
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
// Up to where each rule leaves at most the part `allowed` of its weight, in units of
// lumping_error(L).
HermiteReach hermite_edge_reach(double allowed);
HermiteReach hermite_face_reach(double allowed);
inline std::size_t hermite_rule(const HermiteReach& reach2, double z2) {
  std::size_t k = 0;
  for (const double limit : reach2) k += z2 > limit;
  return k;
}

}  // namespace rholm
