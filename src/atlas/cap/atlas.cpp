#include "rholm/atlas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "atlas/cap/cap_eval.h"
#include "rholm/error.h"

namespace rholm {

const char* to_string(CapBlend blend) { return blend == CapBlend::kSpline ? "spline" : "smooth"; }

CapBlend parse_cap_blend(const std::string& name) {
  for (const CapBlend blend : {CapBlend::kSmooth, CapBlend::kSpline}) {
    if (name == to_string(blend)) return blend;
  }
  throw Error(ErrorCode::kInvalidInput,
              "caps are blended by 'smooth' or 'spline', not '" + name + "'");
}

const char* to_string(CapExtension extension) {
  return extension == CapExtension::kSphere ? "sphere" : "zero";
}

CapExtension parse_cap_extension(const std::string& name) {
  for (const CapExtension extension : {CapExtension::kZero, CapExtension::kSphere}) {
    if (name == to_string(extension)) return extension;
  }
  throw Error(ErrorCode::kInvalidInput,
              "beyond its points a cap is 'zero' or its 'sphere', not '" + name + "'");
}

std::size_t n_coefficients(CapBasis basis, int degree) {
  const auto l = static_cast<std::size_t>(degree);
  return basis == CapBasis::kFull ? (l + 1) * (l + 1) : (l + 1) * (l + 2) / 2;
}

int highest_degree(const Atlas& atlas) {
  int degree = 0;
  for (const Cap& cap : atlas.caps) degree = std::max<int>(degree, cap.degree);
  return degree;
}

CapValue evaluate(const Cap& cap, std::span<const double> coefficients, const Vec3& x) {
  CapPoints point;
  point.add(x - cap.frame.seed(), cap.frame.z, 1);
  point.pad();
  std::array<double, 8> distance{};
  std::array<double, 24> surface{}, normal{};
  cap_distances(cap, coefficients, point, distance);
  cap_surface(cap, coefficients, point, surface, normal);
  if (!std::isfinite(distance[0])) return {};
  return {distance[0], {normal[0], normal[8], normal[16]}, true};
}

}  // namespace rholm
