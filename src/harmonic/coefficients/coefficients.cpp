#include "rholm/coefficients.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

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

}  // namespace rholm
