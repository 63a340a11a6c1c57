// Normal equations of even harmonics by their moments (method 7.4). Layer: atlas.
#pragma once

#include <cstddef>
#include <vector>

#include "base/aligned_array.h"

namespace rholm {

// Points as a fit of harmonics with l + m even sees them: rows of `length`, a multiple of
// kCapLanes, zeros of weight beyond the last point.
struct EvenPoints {
  enum Row { kValue, kSlope1, kSlope2, kWeight, kX, kY, kZ, kS1, kS2, kRows };
  const double* rows = nullptr;  // right-hand sides, times their weights; place on the sphere
  std::size_t length = 0;
  double gradient_weight = 0;  // of a slope's weight, that of the value
  const double* row(Row which) const { return rows + which * length; }
};

struct EvenMoments {  // scratch memory
  AlignedArray<double> lanes;
  std::vector<double> sums;
};

// The matrix of normal_equations.h of all even harmonics up to a degree, without their rows: a
// product of two is a sum of harmonics of up to twice the degree, so that all of the matrix follows
// from the moments sum w^2 Y_lm of the points; and so do products of slopes, for
//   grad Y_a . grad Y_b = (Laplacian(Y_a Y_b) + (l_a (l_a + 1) + l_b (l_b + 1)) Y_a Y_b) / 2.
void make_even_matrix(const EvenPoints& points, int degree, EvenMoments& scratch, double* matrix);

}  // namespace rholm
