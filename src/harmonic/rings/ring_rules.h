// Rings and weights that integrate over the colatitude.
#pragma once

#include <cstddef>
#include <vector>

namespace rholm {

// sum_i w_i f(theta_i) = int_0^pi f sin(theta) dtheta.
struct RingRule {
  std::vector<double> colatitudes;  // ascending, symmetric about the equator
  std::vector<double> weights;
};

// Exact for polynomials in cos(theta) of degree 2n - 1. Colatitudes are accurate relative to
// themselves, where the arccos of a node near 1 would not be. O(n^2).
RingRule gauss_ring_rule(std::size_t n);

// theta_i = (i + 1/2) pi / n, exact for degree n - 1 (Fejer).
RingRule fejer_ring_rule(std::size_t n);

}  // namespace rholm
