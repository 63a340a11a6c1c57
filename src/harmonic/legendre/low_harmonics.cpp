#include "harmonic/legendre/low_harmonics.h"

#include <cmath>
#include <numbers>

namespace rholm {
namespace {

LowHarmonics make() {
  LowHarmonics h{};
  h.start[0] = std::sqrt(0.25 / std::numbers::pi);
  for (int m = 1; m <= kMaxLowDegree; ++m) {
    // (2m+1)/(2m), and twice that at m = 1: cosine and sine share what e^{im phi} has.
    h.start[m] = h.start[m - 1] * std::sqrt((m == 1 ? 2.0 : 1.0) * (2.0 * m + 1) / (2.0 * m));
  }
  for (int m = 0; m <= kMaxLowDegree; ++m) {
    for (int l = m + 1; l <= kMaxLowDegree; ++l) {
      const double ll = l, mm = m, k = l - 1;
      h.a[m][l] = std::sqrt((4 * ll * ll - 1) / (ll * ll - mm * mm));
      h.b[m][l] = std::sqrt((k * k - mm * mm) / (4 * k * k - 1));
    }
  }
  return h;
}

}  // namespace

const LowHarmonics& low_harmonics() {
  static const LowHarmonics harmonics = make();
  return harmonics;
}

}  // namespace rholm
