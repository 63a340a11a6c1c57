#include "harmonic/coefficients/laplacian.h"

namespace rholm {

void divide_by_eigenvalue(Coefficients& c) {
  c.c(0, 0) = 0;
  for (int l = 1; l <= c.degree(); ++l) {
    const double factor = 1.0 / (static_cast<double>(l) * (l + 1));
    for (int m = 0; m <= l; ++m) {
      c.c(l, m) *= factor;
      c.s(l, m) *= factor;
    }
  }
}

}  // namespace rholm
