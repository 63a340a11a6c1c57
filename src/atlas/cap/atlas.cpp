#include "rholm/atlas.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "atlas/cap/cap_eval.h"
#include "rholm/error.h"

namespace rholm {

EnumNames names_of(CapBasis) {
  static constexpr std::array kNames = {"full", "even"};
  return {"basis of a cap", kNames};
}

EnumNames names_of(CapBlend) {
  static constexpr std::array kNames = {"smooth", "spline"};
  return {"blend of caps", kNames};
}

EnumNames names_of(CapExtension) {
  static constexpr std::array kNames = {"zero", "sphere"};
  return {"extension of a cap", kNames};
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
