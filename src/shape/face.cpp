#include "shape/face.h"

#include <algorithm>
#include <cmath>

namespace rholm {
namespace {

// Returns a b - c d to about one rounding of the result (Kahan; error bound 1.5 ulp: Jeannerod,
// Louvet, Muller 2013).
double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d;
  return std::fma(a, b, -cd) + std::fma(-c, d, cd);
}

Vec3 accurate_cross(const Vec3& a, const Vec3& b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

double largest_modulus(const Vec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

// Largest sine of an angle at which the accurate product replaces the plain one, which loses -log2
// of this many bits. Chosen: one triangle in a thousand of a usual mesh needs the slower product.
constexpr double kIllConditioned = 0x1p-10;

// Coordinates are known to half an ulp: 2^-53 of their modulus. Both ends of the longest edge and
// the apex move by at most sqrt(3) times this, so the height is uncertain by 2 sqrt(3) 2^-53 = 3.5
// 2^-53. The products above add 5 2^-53 times a quarter of the longest edge. This edge is at most 2
// sqrt(3) times the largest coordinate, which gives 4.3 2^-53. The sum is below 8 2^-53.
constexpr double kHeightRounding = 8 * 0x1p-53;

}  // namespace

UnitFrame unit_frame(const Bounds& bounds) {
  // Uses halves, so that the difference of the largest numbers does not overflow.
  const Vec3 half = 0.5 * bounds.max - 0.5 * bounds.min;
  const double extent = largest_modulus(half);
  UnitFrame frame;
  if (extent > 0) frame.exponent = std::min(1023, -1 - std::ilogb(extent));
  frame.scale = std::ldexp(1.0, frame.exponent);
  frame.center = frame.scale * bounds.min + frame.scale * half;
  return frame;
}

FaceNormal face_normal(const std::array<Vec3, 3>& corners) {
  const std::array<Vec3, 3>& p = corners;
  const Vec3 edges[3] = {p[2] - p[1], p[0] - p[2], p[1] - p[0]};  // edge k is opposite corner k
  const double squares[3] = {dot(edges[0], edges[0]), dot(edges[1], edges[1]),
                             dot(edges[2], edges[2])};
  // The two shorter edges have the smallest product of lengths, and so the smallest rounding.
  const int apex = static_cast<int>(std::max_element(squares, squares + 3) - squares);
  const int i = apex == 2 ? 0 : apex + 1, j = apex == 0 ? 2 : apex - 1;
  Vec3 normal = cross(edges[i], edges[j]);
  double length = norm(normal);
  if (length * length < kIllConditioned * kIllConditioned * squares[i] * squares[j]) {
    normal = accurate_cross(edges[i], edges[j]);
    length = norm(normal);
  }
  const double largest =
      std::max({largest_modulus(p[0]), largest_modulus(p[1]), largest_modulus(p[2])});
  const double longest = std::sqrt(squares[apex]);
  return {.twice_area = normal, .degenerate = length <= kHeightRounding * largest * longest};
}

}  // namespace rholm
