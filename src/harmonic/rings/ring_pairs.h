// Between values on rings and their orders in phi. Rings come as pairs symmetric about the equator,
// whose two real rows share one complex transform.
#pragma once

#include <cstddef>
#include <span>

#include "base/aligned_array.h"
#include "base/parallel.h"
#include "rholm/context.h"

namespace rholm {

// Even and odd parts of re_m = sum_k f(phi_k) cos(m phi_k) and im_m = sum_k f(phi_k) sin(m phi_k),
// or of the terms re_m cos(m phi) + im_m sin(m phi), of ring i and its mirror image: at(i, m) has
// {even_re, even_im, odd_re, odd_im}, F(theta) = even + odd, F(pi - theta) = even - odd.
// An equator ring has odd parts 0.
struct RingPairs {
  RingPairs(std::size_t rings, std::size_t longitudes, int degree);
  double* at(std::size_t pair, std::size_t m) { return &values[4 * (pair * orders + m)]; }

  std::size_t n_theta, n_phi, orders;  // n_phi >= 2 orders - 1
  std::size_t n_pairs;                 // with an equator ring
  AlignedArray<double> values;
};

// From and to values [ring][longitude]. The first throws InvalidInput for one that is not finite.
// Sums over phi: an even part is that of both rings' sums, F(theta) + F(pi - theta), at the equator
// F, as ring_adjoint() wants it.
void values_to_pairs(std::span<const double> values, RingPairs& pairs, const Context& context,
                     const ParallelStage& stage);
// Terms: even and odd parts as ring_forward() gives them.
void pairs_to_values(RingPairs& pairs, std::span<double> values, const Context& context,
                     const ParallelStage& stage);

}  // namespace rholm
