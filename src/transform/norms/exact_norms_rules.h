// Symmetric cubature on triangles for means of powers of |x|, from squares of lengths alone.
//
// Notation: r_i = |p_i|^2 of the corners, l_i the square of the edge opposite to corner i, g the
// square of the centroid's distance. At the barycentric point b
//   |x|^2 = sum b_i r_i - b_0 b_1 l_2 - b_1 b_2 l_0 - b_2 b_0 l_1,
//   g = sum r_i / 3 - sum l_i / 9.
// In units of g, x = c + y with |c| = 1. Gegenbauer's series, homogeneous in y term by term, are:
//   |x|^-1 = sum (-1)^n |y|^n P_n,     |x|^-3 = sum (-1)^n |y|^n C_n^(3/2).
// Here |P_n| <= 1. Let t = theta = longest edge / |c|. The mean of |y|^n is at most the mean over a
// needle with its mass towards one end, which is
//   int_(-1/3)^(2/3) 2 (2/3 - s) |s|^n ds t^n = 0.0015 t^6, 0.00021 t^9.
// The sum of a rule is nearly the same. So the rules of degree 5 and 8 err by at most 0.003 t^6 and
// 0.0005 t^9: 4e-15 and 5e-15 at the reaches below.
#pragma once

namespace rholm {

// Three points: one b_i is 1 - 2a, the two others are a. Each point has the weight.
struct TripleOrbit {
  double a, weight;
};
// Six points: the permutations of (a, b, 1 - a - b). Each point has the weight.
struct SextupleOrbit {
  double a, b, weight;
};
// The centroid has the remaining weight. It adds nothing where it is the point of reference.

// Degree 5: Radon 1948.
inline constexpr double kRoot15 = 3.872983346207417;
inline constexpr TripleOrbit kDegree5[2] = {{(6 - kRoot15) / 21, (155 - kRoot15) / 1200},
                                            {(6 + kRoot15) / 21, (155 + kRoot15) / 1200}};
// Degree 8: Dunavant 1985, refined to double precision by Newton's method on the moments.
inline constexpr TripleOrbit kDegree8[3] = {{0.4592925882927232, 0.09509163426728462},
                                            {0.1705693077517602, 0.10321737053471824},
                                            {0.05054722831703098, 0.03245849762319808}};
inline constexpr SextupleOrbit kDegree8Six = {0.2631128296346381, 0.7284923929554042,
                                              0.027230314174434993};

// Largest (longest edge)^2 / g for each rule.
inline constexpr double kReach5 = 0.0105 * 0.0105;
inline constexpr double kReach8 = 0.06 * 0.06;
// v = |x|^2/g - 1 is within w = 2s + s^2, s = 2/3 theta: 0.0141 and 0.0816. The binomial series of
// (1 + v)^(-1/2) up to v^6 and v^10 leaves .21 w^7 and .17 w^11 times the mean of (v/w)^n. For a
// needle that points at the centre the mean is at most 0.9/((n+1)(n+2)): 3e-16, 1.2e-15.
inline constexpr int kTerms5 = 6;
inline constexpr int kTerms8 = 10;

}  // namespace rholm
