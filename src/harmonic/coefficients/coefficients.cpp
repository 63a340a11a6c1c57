#include "rholm/coefficients.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/compensated_sum.h"
#include "rholm/error.h"

namespace rholm {
namespace {

std::size_t array_size(int degree) {
  if (degree < 0 || degree > kMaxDegree) {
    throw Error(ErrorCode::kInvalidInput, "degree " + std::to_string(degree) +
                                              " is out of range: choose one from 0 to " +
                                              std::to_string(kMaxDegree));
  }
  const auto side = static_cast<std::size_t>(degree) + 1;
  return 2 * side * side;
}

}  // namespace

Coefficients::Coefficients(int degree) : degree_(degree), values_(array_size(degree)) {}

Coefficients Coefficients::resized(int degree) const {
  Coefficients result(degree);
  const int common = std::min(degree, degree_);
  for (int l = 0; l <= common; ++l) {
    for (int m = 0; m <= l; ++m) {
      result.c(l, m) = c(l, m);
      result.s(l, m) = s(l, m);
    }
  }
  return result;
}

EnumNames names_of(RadialFunction) {
  static constexpr const char* kNames[] = {"radius", "gauge", "other"};
  return {"function", kNames};
}

void require_surface(const Expansion& expansion) {
  if (expansion.function != RadialFunction::kOther) return;
  throw Error(ErrorCode::kUnsupported,
              "the coefficients are not the radius of a surface, but of something else, as a "
              "gravity field is: there is no surface to make, measure or compare");
}

void require_star_shaped(const Expansion& expansion, const std::string& what) {
  if (!expansion.signed_sum) return;
  throw Error(
      ErrorCode::kUnsupported,
      "the expansion is the signed sum of the radii of a surface that is not star-shaped: " + what +
          " would not be of the body; make an atlas of it (compress(), 'rholm analyze "
          "--atlas')");
}

void check_gravity(const Expansion& expansion, const std::string& name) {
  if (!expansion.gravity) return;
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorCode::kInvalidInput, name + ": " + what);
  };
  const auto check = [&](double value, const char* what) {
    if (std::isfinite(value) && value > 0) return;
    refuse(fmt::format("the {} is {}: it must be finite and above 0", what, value));
  };
  check(expansion.gravity->gravity_constant, "gravity constant");
  check(expansion.gravity->reference_radius, "reference radius");
  if (expansion.function == RadialFunction::kOther) return;
  refuse(
      fmt::format("a gravity constant and a reference radius are of a gravity field, whose "
                  "function is 'other', not '{}'",
                  to_string(expansion.function)));
}

EnumNames names_of(Normalization) {
  static constexpr const char* kNames[] = {"orthonormal", "4pi", "schmidt"};
  return {"normalization", kNames};
}

std::vector<double> power_spectrum(const Coefficients& coefficients) {
  std::vector<double> energy(static_cast<std::size_t>(coefficients.degree()) + 1);
  for (int l = 0; l <= coefficients.degree(); ++l) {
    // Compensated, because the truncation error is a difference of nearly equal norms, (M7).
    CompensatedSum sum;
    for (int m = 0; m <= l; ++m) {
      sum.add(coefficients.c(l, m) * coefficients.c(l, m));
      sum.add(coefficients.s(l, m) * coefficients.s(l, m));
    }
    energy[l] = sum.value();
  }
  return energy;
}

namespace {

// Returns the divisor that takes orthonormal coefficients of degree l to the external convention,
// rounded once. The way back multiplies by the same number. A round trip is therefore right to one
// unit in the last place, and the constant 1, which is sqrt(4 pi) inside, is exactly 1 outside.
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
        *value = other + 0.0;  // Adding 0 turns -0 into 0.
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
