// Transforms between values on rings and their orders in phi. Rings come as pairs symmetric about
// the equator, and the two real rows of a pair share one complex transform.
#pragma once

#include <cstddef>
#include <span>

#include "base/aligned_array.h"
#include "base/parallel.h"
#include "rholm/context.h"

namespace rholm {

// Sums re_m = sum_k f(phi_k) cos(m phi_k) and im_m = sum_k f(phi_k) sin(m phi_k), or terms re_m
// cos(m phi) + im_m sin(m phi). For ring i and its mirror image, at(i, m) has the even and odd
// parts {even_re, even_im, odd_re, odd_im}. F(theta) = even + odd, F(pi - theta) = even - odd. A
// ring on the equator has odd parts 0.
struct RingPairs {
  RingPairs(std::size_t rings, std::size_t longitudes, int degree);
  double* at(std::size_t pair, std::size_t m) { return &values[4 * (pair * orders + m)]; }

  std::size_t n_theta, n_phi, orders;  // n_phi >= 2 orders - 1
  std::size_t n_pairs;                 // including a ring on the equator
  AlignedArray<double> values;
};

// Computes the sums over phi of values [ring][longitude], as ring_adjoint() takes them: an even
// part is F(theta) + F(pi - theta), but F at the equator. Throws InvalidInput if a value is not
// finite.
void values_to_pairs(std::span<const double> values, RingPairs& pairs, const Context& context,
                     const ParallelStage& stage);
// Computes values [ring][longitude] from terms, whose parts are as ring_forward() returns them.
void pairs_to_values(RingPairs& pairs, std::span<double> values, const Context& context,
                     const ParallelStage& stage);

}  // namespace rholm
