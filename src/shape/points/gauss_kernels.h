// The inner loops of GaussField: one place against a list of sources.
#pragma once

#include <cstddef>

namespace rholm {

inline constexpr std::size_t kGaussLanes = 16;  // lists are padded to a multiple of it

// Sources by columns: places, vectors (or one number, the first of them), squared widths. What
// pads the list is far away and of no strength.
struct GaussSources {
  const float* x;
  const float* y;
  const float* z;
  const float* a[3];
  const float* width2;
  std::size_t n;  // a multiple of kGaussLanes
};

// With r = source - place, d = max(|r|, width of the source) or, in the other two, of the place:
// sum a . r / d^3,
float gauss_value(const GaussSources& sources, const float place[3]);
// sum a[0] r / d^3,
void gauss_adjoint(const GaussSources& sources, const float place[3], float width2, float sum[3]);
// sum a / d^3 - 3 r (a . r) / d^5, the last only where |r| is the larger: minus the gradient of the
// first.
void gauss_fall(const GaussSources& sources, const float place[3], float width2, float sum[3]);

}  // namespace rholm
