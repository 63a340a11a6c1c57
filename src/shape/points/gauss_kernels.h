// Computes the sums of GaussField at one place over a list of sources.
#pragma once

#include <cstddef>

namespace rholm {

inline constexpr std::size_t kGaussLanes = 16;  // lists are padded to a multiple of this

// Sources by columns: places, vectors (for gauss_adjoint() one number, in a[0]), squared widths.
// Padding sources are far away and have the vector 0.
struct GaussSources {
  const float* x;
  const float* y;
  const float* z;
  const float* a[3];
  const float* width2;
  std::size_t n;  // a multiple of kGaussLanes
};

// Each sum uses r = source - place and d = max(|r|, w). w is the width of the source in
// gauss_value(), and of the place in the other two. This one: sum a . r / d^3.
float gauss_value(const GaussSources& sources, const float place[3]);
// Computes sum a[0] r / d^3.
void gauss_adjoint(const GaussSources& sources, const float place[3], float width2, float sum[3]);
// Computes sum a / d^3 - 3 r (a . r) / d^5, minus the gradient of gauss_value(). The second term
// counts only where |r| > w.
void gauss_fall(const GaussSources& sources, const float place[3], float width2, float sum[3]);

}  // namespace rholm
