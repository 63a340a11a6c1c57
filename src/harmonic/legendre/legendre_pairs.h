// Moments of differences between pairs of sources, which estimate the error of a Monte Carlo sum.
#pragma once

#include <cstddef>

#include "harmonic/legendre/legendre_kernels.h"

namespace rholm {

// One source of each pair, in arrays padded to kLegendreLanes as for legendre_adjoint().
struct PairSide {
  const double* x = nullptr;   // cos theta
  const double* s = nullptr;   // sin theta
  const double* re = nullptr;  // complex weight for this order
  const double* im = nullptr;
};

// Sums over pairs for the cosine or for the sine coefficients, with index l - m.
struct PairMoments {
  double* sum = nullptr;     // sum of a + b, a = Pt_lm(x_a) re_a
  double* square = nullptr;  // sum of (a - b)^2
  double* fourth = nullptr;  // sum of (a - b)^4
};

// Adds the moments of n pairs to c and s; n is a multiple of kLegendreLanes.
void legendre_pair_moments(const LegendreOrder& order, const PairSide& a, const PairSide& b,
                           std::size_t n, const PairMoments& c, const PairMoments& s);

}  // namespace rholm
