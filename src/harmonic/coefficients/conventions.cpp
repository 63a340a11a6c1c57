// Coefficients in other conventions. The function f = sum of coefficient times basis function
// stays the same, so coefficients scale by the inverse of what the basis functions scale by.
//   orthonormal      integral of Y^2 over the sphere 1, mean square 1/(4 pi)
//   4 pi             mean square 1:         Y_4pi = sqrt(4 pi) Y,        C_4pi = C / sqrt(4 pi)
//   Schmidt          mean square 1/(2l+1):  Y_S = Y_4pi / sqrt(2l+1),    C_S = C_4pi sqrt(2l+1)
//   csphase -1       Y' = (-1)^m Y,                                      C' = (-1)^m C
#include <cmath>
#include <numbers>
#include <string>

#include "rholm/coefficients.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// One divisor per degree that takes orthonormal coefficients to the others, rounded once. Going
// back multiplies by the same number, so that a round trip is right to one unit in the last place,
// and the constant 1, sqrt(4 pi) inside, is exactly 1 outside.
double external_divisor(Normalization normalization, int l) {
  switch (normalization) {
    case Normalization::kOrthonormal:
      return 1;
    case Normalization::kFourPi:
      return std::sqrt(4 * std::numbers::pi);
    case Normalization::kSchmidt:
      return std::sqrt(4 * std::numbers::pi / (2.0 * l + 1));
  }
  return 1;
}

enum class Way { kToExternal, kToInternal };

Coefficients convert(const Coefficients& from, const Convention& convention, Way way) {
  if (convention.csphase != 1 && convention.csphase != -1) {
    throw Error(ErrorCode::kInvalidInput, "csphase " + std::to_string(convention.csphase) +
                                              " is not a phase convention: it must be 1 or -1");
  }
  Coefficients result = from;
  if (convention == Convention{Normalization::kOrthonormal, 1}) return result;
  for (int l = 0; l <= from.degree(); ++l) {
    const double divisor = external_divisor(convention.normalization, l);
    for (int m = 0; m <= l; ++m) {
      const double signed_divisor = m % 2 == 1 ? convention.csphase * divisor : divisor;
      for (double* value : {&result.c(l, m), &result.s(l, m)}) {
        const double other =
            way == Way::kToExternal ? *value / signed_divisor : *value * signed_divisor;
        *value = other + 0.0;  // 0, not -0
      }
    }
  }
  return result;
}

}  // namespace

Coefficients to_convention(const Coefficients& internal, const Convention& convention) {
  return convert(internal, convention, Way::kToExternal);
}

Coefficients from_convention(const Coefficients& external, const Convention& convention) {
  return convert(external, convention, Way::kToInternal);
}

}  // namespace rholm
