// Hermite's rules, which lump edges and faces at their vertices, with gradients (VG) or with
// Hessians as well (VGH), and their errors by the model of error_model.h.
#pragma once

#include <array>
#include <cstddef>

namespace rholm {

// Returns the error of lumping (VG) per unit of weight and z^4 / L. Hermite's rule gives 1/720, the
// mean of cos^8 over directions is 35/128, and p = 4.
double lumping_error(int degree);

// Hermite's rules with values, gradients and Hessians at the ends of an edge or the corners of a
// face (VGH), and nodes between where these are not enough. The mean over an edge e from a to b is
//   value (f(a) + f(b)) + gradient e . (f'(a) - f'(b)) + hessian ee : (f''(a) + f''(b)) + nodes,
// exact to degree 5, 7, 9 with none, one, two nodes. The weights solve the moment equations. A
// constant is the remainder term's times the root mean square of cos^p over directions.
struct HermiteEdge {
  double value, gradient, hessian;
  int nodes;        // number of nodes, evenly spaced between the ends
  double node;      // weight of each node
  double constant;  // see error_model.h: C z^p
  int power;
};
inline constexpr std::size_t kHermiteEdgeRules = 3, kHermiteFaceRules = 5;
inline constexpr std::array<HermiteEdge, kHermiteEdgeRules> kHermiteEdges = {{
    {1.0 / 2, 1.0 / 10, 1.0 / 120, 0, 0, 4.71e-6, 6},
    {19.0 / 70, 1.0 / 35, 1.0 / 840, 1, 16.0 / 35, 2.18e-9, 8},
    {391.0 / 2240, 13.0 / 1120, 1.0 / 3360, 2, 729.0 / 2240, 9.28e-13, 10},
}};

// Nodes at the permutations of (at, at, 1 - 2 at) or (at, other, 1 - at - other), all of one
// weight. There are none if the weight is 0.
struct HermiteOrbit {
  double weight = 0, at = 0, other = 0;
  constexpr int nodes() const { return weight == 0 ? 0 : at == other ? 3 : 6; }
};

// The mean over a face, where a and b are the edges that leave a corner, is:
//   Sum over corners of value f + gradient (a + b) . f' + square (aa + bb) : f''
//     + product (ab + ba) : f''  and over the nodes, center f(centroid) and the orbits.
// It is exact to degree 4, 5, 6, 7, 8 with none, one, four, six, ten nodes. The rules of six and
// ten nodes were found by Newton's method on the moments of invariant polynomials. Constants were
// found with plane waves like the other rules' constants, the largest for z = 1 ... 8. Constants of
// six and ten nodes are of a needle, where they are 1.2 and 2.2 times as large.
struct HermiteFace {
  double value, gradient, square, product;
  double center;
  std::array<HermiteOrbit, 2> orbits;
  double constant;
  int power;
  constexpr int nodes() const { return (center != 0) + orbits[0].nodes() + orbits[1].nodes(); }
};
inline constexpr std::array<HermiteFace, kHermiteFaceRules> kHermiteFaces = {{
    {1.0 / 3, 1.0 / 20, 1.0 / 360, 1.0 / 360, 0, {}, 2.7e-5, 5},
    {43.0 / 210, 1.0 / 42, 1.0 / 630, 1.0 / 2520, 27.0 / 70, {}, 1.8e-6, 6},
    {2393.0 / 22500,
     19.0 / 2250,
     1.0 / 3600,
     1.0 / 5600,
     1377.0 / 8960,
     {{{(1 - 2393.0 / 7500 - 1377.0 / 8960) / 3, 5.0 / 11, 5.0 / 11}}},
     9.6e-9,
     7},
    {0.073035166823501283,
     0.0047463996846981876,
     0.00015289370359711076,
     0.000053687354390761554,
     0,
     {{{0.16433586884577449, 0.22149966410226464, 0.22149966410226464},
       {0.095962297664057558, 0.47818733995690262, 0.47818733995690262}}},
     6.2e-10,
     8},
    {0.047286245259513240,
     0.0024164482416339148,
     0.000050732886645426225,
     0.000030178573631152933,
     0.098293825866482431,
     {{{0.10533976452608170, 0.21278909759712111, 0.21278909759712111},
       {0.073971357462788789, 0.051157439469980935, 0.32830674136892569}}},
     8.2e-12,
     9},
}};

// Weight of the bending in z^2 of an edge for these rules (see Extent), as for VG, with p = 8.
inline constexpr double kHermiteBend = 25;

// C z^p of each rule in units of lumping_error(L): the l2 factors differ by sqrt(1 / (p - 1)).
inline constexpr double kLumpingConstant = 0.522912 / 720;  // sqrt(35/128) / 720
constexpr double square_root(double x) {
  double root = 1;
  for (int k = 0; k < 50; ++k) root = (root + x / root) / 2;
  return root;
}
template <typename Rule, std::size_t kRules>
constexpr std::array<double, kRules> hermite_units(const std::array<Rule, kRules>& rules) {
  std::array<double, kRules> units = {};
  for (std::size_t k = 0; k < units.size(); ++k) {
    units[k] = rules[k].constant / kLumpingConstant * square_root(3.0 / (rules[k].power - 1));
  }
  return units;
}
inline constexpr auto kHermiteEdgeUnits = hermite_units(kHermiteEdges);
inline constexpr auto kHermiteFaceUnits = hermite_units(kHermiteFaces);

// Limits for the cheapest rule for an extent: rule k reaches to z^2 = reach2[k], the last to any.
using HermiteEdgeReach = std::array<double, kHermiteEdgeRules - 1>;
using HermiteFaceReach = std::array<double, kHermiteFaceRules - 1>;
// Return the z^2 up to which each rule leaves at most the part `allowed` of its weight, in units of
// lumping_error(L).
HermiteEdgeReach hermite_edge_reach(double allowed);
HermiteFaceReach hermite_face_reach(double allowed);
template <std::size_t kLimits>
std::size_t hermite_rule(const std::array<double, kLimits>& reach2, double z2) {
  std::size_t k = 0;
  for (const double limit : reach2) k += z2 > limit;
  return k;
}

}  // namespace rholm
