// Rings and weights that integrate over the colatitude.
#pragma once

#include <cstddef>
#include <vector>

namespace rholm {

// A rule with sum_i w_i f(theta_i) = int_0^pi f sin(theta) dtheta.
struct RingRule {
  std::vector<double> colatitudes;  // ascending, symmetric about the equator
  std::vector<double> weights;
};

// Returns a rule that is exact for polynomials in cos(theta) of degree 2n - 1, in O(n^2).
// Colatitudes have full relative accuracy, unlike the arccos of a node near 1.
RingRule gauss_ring_rule(std::size_t n);

// Returns the rule with theta_i = (i + 1/2) pi / n, which is exact for degree n - 1 (Fejer).
RingRule fejer_ring_rule(std::size_t n);

}  // namespace rholm
