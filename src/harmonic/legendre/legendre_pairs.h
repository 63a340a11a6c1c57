// Moments of differences between pairs of sources: what a Monte Carlo sum knows of its own error.
#pragma once

#include <cstddef>

#include "harmonic/legendre/legendre_kernels.h"

namespace rholm {

// One source of each pair, in arrays padded to kLegendreLanes as for legendre_adjoint().
struct PairSide {
  const double* x = nullptr;   // cos theta
  const double* s = nullptr;   // sin theta
  const double* re = nullptr;  // its number of this order
  const double* im = nullptr;
};

// Sums over pairs, index l - m, of the cosine or the sine coefficients.
struct PairMoments {
  double* sum = nullptr;     // of a + b, a = Pt_lm(x_a) re_a
  double* square = nullptr;  // of (a - b)^2
  double* fourth = nullptr;  // of (a - b)^4
};

// Adds those of n pairs, n a multiple of kLegendreLanes.
void legendre_pair_moments(const LegendreOrder& order, const PairSide& a, const PairSide& b,
                           std::size_t n, const PairMoments& c, const PairMoments& s);

}  // namespace rholm
