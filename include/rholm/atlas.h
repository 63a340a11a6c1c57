// An atlas: a surface of any genus as overlapping caps, each a function on a sphere of its own.
// Layer: atlas.
//
// A cap looks at the surface from a centre on its inner side. A point at distance r in direction u
// from the centre has local direction (sin theta cos phi, sin theta sin phi, cos theta) in the
// cap's frame; the sphere is opened by the stereographic dilation tan(theta'/2) = a tan(theta/2),
// so that a small cap fills a hemisphere, and the surface is (method 7.1)
//   r(u) = R_0 (1 + sum_lm [C_lm cos(m phi) + S_lm sin(m phi)] N_m P_lm(cos theta')),
// in the real orthonormal harmonics of coefficients.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rholm/cap_frame.h"
#include "rholm/fields.h"
#include "rholm/vec3.h"

namespace rholm {

// The support of a cap: with (p, q, h) = x - seed along the frame's axes, where
//   s^2 = xx (p - px)^2 + 2 xy (p - px)(q - py) + yy (q - py)^2 + (h / support)^2 < 1:
// the ellipse of its points, so that it has no weight where it has none.
struct CapSupport {
  double px = 0, py = 0;          // middle of the ellipse
  double xx = 0, xy = 0, yy = 0;  // its form, in 1/unit^2
};

// Which harmonics a cap uses.
enum class CapBasis : std::uint8_t {
  kFull,  // all up to its degree, (L+1)^2
  kEven   // those with l + m even, (L+1)(L+2)/2: complete on a hemisphere (method 7.8)
};

EnumNames names_of(CapBasis basis);  // "full", "even"

// The number of coefficients of a cap.
std::size_t n_coefficients(CapBasis basis, int degree);

// One cap: its sphere, its support, and where its coefficients are.
struct Cap {
  CapFrame frame;                    // of its sphere, in the coordinates of the shape
  CapSupport where;                  // an ellipse about its seed
  CapBasis basis = CapBasis::kFull;  // says how many coefficients it has
  std::uint16_t degree = 0;          // L
  // Its coefficients start here in Atlas::coefficients. Order: l = 0, 1, ..., in each l the orders
  // m = 0, then C and S of m = 1, 2, ..., l; the even basis leaves out those with l + m odd.
  std::size_t first = 0;
  double error = 0;      // rms distance of the fitted points to the cap
  double area = 0;       // of the surface that it was made for: all caps' add up to the whole
  double weight = 1;     // of its potential, a factor of its blend weight
  double deviation = 0;  // largest distance of its surface from the tangent plane of the seed
};

// Its list (fields.h), without its sphere and its support.
template <typename Visitor>
void visit_fields(FieldsOf<Cap>, const Visitor& field) {
  using C = Cap;
  field(&C::basis, {.name = "basis", .help = "which harmonics it uses"});
  field(&C::degree, {.name = "degree", .help = "its highest degree"});
  field(&C::first, {.name = "first", .help = "where its coefficients start"});
  field(&C::error, {.name = "error",
                    .help = "root mean square distance of the fitted points to it",
                    .unit = FieldUnit::kLength});
  field(&C::area, {.name = "area", .help = "of the surface that it was made for"});
  field(&C::weight, {.name = "weight", .help = "a factor of its blend weight"});
  field(&C::deviation,
        {.name = "deviation",
         .help = "largest distance of its surface from the tangent plane of the seed",
         .unit = FieldUnit::kLength});
}

// The blend weight of a cap at s^2 < 1 of CapSupport. Either is multiplied by (1 - g^2 / T^2)^2 of
// its potential g, T the band, and where points are noisy by 1 / (1 + |grad r|^2 / r^2), the
// squared cosine of the angle between its surface and the sphere: where a cap leans, others see
// better.
enum class CapBlend : std::uint8_t {
  kSmooth,  // (1 - s^2)^3
  kSpline   // the paper's quadratic B-spline of 3 s / 2 (P44)
};
EnumNames names_of(CapBlend blend);  // "smooth", "spline"

// What a cap that is found by integrals over its points is beyond them.
enum class CapExtension : std::uint8_t {
  kZero,   // zero, as the paper has it
  kSphere  // the sphere it lies on, so that it jumps by its height over the sphere only
};
EnumNames names_of(CapExtension extension);  // "zero", "sphere"

// The caps of a surface. Lengths are in the unit of the points it was made of.
struct Atlas {
  std::vector<Cap> caps;               // in any order
  std::vector<double> coefficients;    // of all caps, each from its Cap::first on
  CapBlend blend = CapBlend::kSmooth;  // of caps where supports overlap
  double spacing = 0;   // of the points: median distance to the nearest neighbours' circle
  double noise = 0;     // standard deviation of the points' distances to the surface; 0 if clean
  double diagonal = 0;  // of the points' bounding box
  // Where caps disagree by less they are averaged, so caps have a weight within it of a grid's
  // points, or within 2.5 steps of the grid if that is more.
  double band = 0;

  // Those of one of these caps; good as long as the atlas.
  std::span<const double> coefficients_of(const Cap& cap) const {
    return {coefficients.data() + cap.first, n_coefficients(cap.basis, cap.degree)};
  }
};

// Of all caps; 0 without caps.
int highest_degree(const Atlas& atlas);

// The surface's potential as one cap sees it, and its gradient in space.
struct CapValue {
  // g = (|x - c| - r(u)) / sqrt(1 + |grad r|^2 / r^2): a signed distance to first order, positive
  // outside (method 7.5).
  double distance = 0;
  Vec3 gradient;       // of g, to first order: a unit vector across the surface
  bool valid = false;  // false at the centre, behind it, and where r(u) <= 0
};
// At the point x, of a cap with these coefficients. Anywhere, also where the cap has no weight.
CapValue evaluate(const Cap& cap, std::span<const double> coefficients, const Vec3& x);

}  // namespace rholm
