// Arvo's map in a form without cancellation on small triangles. The point c' of the arc from a to c
// at angle t is cos(t) a + sin(t) e. It cuts off the triangle (a, b, c') of solid angle S. Let
// tau = tan(t/2) and V = a.(b x e). By Van Oosterom and Strackee (1983), divided by 1 + cos t,
//   tan(S/2) = a.(b x c') / (1 + a.b + b.c' + c'.a) = tau V / (1 + a.b + tau b.e).
// This is linear in tau. The point on the arc from b to c' then has a uniform 1 - cos(distance from
// b).
#include "paper/monte_carlo/spherical_triangle.h"

#include <algorithm>
#include <cmath>

namespace rholm {
namespace {

// Returns the unit tangent at the unit vector a towards c; any tangent if c = a.
Vec3 tangent(const Vec3& a, const Vec3& c) {
  const Vec3 chord = c - a;
  return normalized(chord - dot(chord, a) * a);
}

}  // namespace

SphericalTriangle spherical_triangle(const std::array<Vec3, 3>& corners, double omega) {
  SphericalTriangle triangle;
  triangle.a = normalized(corners[0]);
  triangle.b = normalized(corners[1]);
  triangle.toward = tangent(triangle.a, normalized(corners[2]));
  triangle.omega = omega;
  const Vec3 chord = triangle.b - triangle.a;
  triangle.one_plus_ab = 2 - dot(chord, chord) / 2;
  triangle.volume = dot(triangle.a, cross(chord, triangle.toward));
  triangle.lean = dot(chord, triangle.toward);
  return triangle;
}

Vec3 uniform_direction(const SphericalTriangle& triangle, double along, double across) {
  const double half = along * triangle.omega / 2;
  const double t =
      2 * std::atan2(std::sin(half) * triangle.one_plus_ab,
                     std::cos(half) * triangle.volume - std::sin(half) * triangle.lean);
  const Vec3 end = std::cos(t) * triangle.a + std::sin(t) * triangle.toward;
  // sin^2(s/2) = across sin^2(s_max/2), and 2 sin(s_max/2) is the chord.
  const double sine = std::sqrt(across) * std::min(1.0, norm(end - triangle.b) / 2);
  const double cosine = std::sqrt(1 - sine * sine);
  return normalized((1 - 2 * sine * sine) * triangle.b +
                    2 * sine * cosine * tangent(triangle.b, end));
}

}  // namespace rholm
