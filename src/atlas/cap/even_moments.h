// Normal equations of even harmonics by their moments (method 7.4). Layer: atlas.
#pragma once

#include <cstddef>
#include <vector>

#include "base/aligned_array.h"

namespace rholm {

// Points for fits of harmonics with l + m even: rows of `length`,
// a multiple of kCapLanes, with weight zero beyond the last point.
struct EvenPoints {
  enum Row { kValue, kSlope1, kSlope2, kWeight, kX, kY, kZ, kS1, kS2, kRows };
  const double* rows = nullptr;  // weighted right-hand sides; position on the sphere
  std::size_t length = 0;
  double gradient_weight = 0;  // weight of a slope relative to the value's weight
  const double* row(Row which) const { return rows + which * length; }
};

struct EvenMoments {  // scratch memory
  AlignedArray<double> lanes;
  std::vector<double> sums;
};

// Computes the matrix of normal_equations.h for all even harmonics up to a degree, without rows.
// A product of two harmonics is a sum of harmonics up to twice the degree. The matrix thus follows
// from the points' moments sum w^2 Y_lm. Products of slopes follow too, because
//   grad Y_a . grad Y_b = (Laplacian(Y_a Y_b) + (l_a (l_a + 1) + l_b (l_b + 1)) Y_a Y_b) / 2.
void make_even_matrix(const EvenPoints& points, int degree, EvenMoments& scratch, double* matrix);

}  // namespace rholm
