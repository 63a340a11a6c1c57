#include <vector>

#include "base/compensated_sum.h"
#include "rholm/coefficients.h"

namespace rholm {

std::vector<double> power_spectrum(const Coefficients& coefficients) {
  std::vector<double> energy(static_cast<std::size_t>(coefficients.degree()) + 1);
  for (int l = 0; l <= coefficients.degree(); ++l) {
    // Compensated: the known truncation error is the difference of two nearly equal norms, (M7).
    CompensatedSum sum;
    for (int m = 0; m <= l; ++m) {
      sum.add(coefficients.c(l, m) * coefficients.c(l, m));
      sum.add(coefficients.s(l, m) * coefficients.s(l, m));
    }
    energy[l] = sum.value();
  }
  return energy;
}

}  // namespace rholm
