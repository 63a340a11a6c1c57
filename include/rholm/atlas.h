// Atlas: a surface of any genus as overlapping caps, each a function on its own sphere.
// Layer: atlas.
//
// A cap sees the surface from a centre on its inner side. A point at distance r in direction u from
// the centre has the local direction (sin theta cos phi, sin theta sin phi, cos theta) in the cap's
// frame. The stereographic dilation tan(theta'/2) = a tan(theta/2) enlarges a small cap to a
// hemisphere. The surface is (method 7.1)
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

// Support of a cap: the points x with s < 1. With (p, q, h) = x - seed along the frame's axes,
//   s^2 = xx (p - px)^2 + 2 xy (p - px)(q - py) + yy (q - py)^2 + (h / support)^2.
// The ellipse contains the cap's points: the cap has no weight where it has no points.
struct CapSupport {
  double px = 0, py = 0;          // centre of the ellipse
  double xx = 0, xy = 0, yy = 0;  // quadratic form of the ellipse, in 1/unit^2
};

// The set of harmonics that a cap uses.
enum class CapBasis : std::uint8_t {
  kFull,  // all harmonics up to its degree, (L+1)^2
  kEven   // harmonics with l + m even, (L+1)(L+2)/2: complete on a hemisphere (method 7.8)
};

EnumNames names_of(CapBasis basis);  // "full", "even"

// Returns the number of coefficients of a cap.
std::size_t n_coefficients(CapBasis basis, int degree);

// One cap: its sphere, its support, and the position of its coefficients.
struct Cap {
  CapFrame frame;                    // frame of its sphere, in the coordinates of the shape
  CapSupport where;                  // its support, an ellipse about its seed
  CapBasis basis = CapBasis::kFull;  // determines the number of coefficients
  std::uint16_t degree = 0;          // L
  // Index of its first coefficient in Atlas::coefficients. Order: l = 0, 1, ..., in each l the
  // orders m = 0, then C and S of m = 1, 2, ..., l; the even basis has no odd l + m.
  std::size_t first = 0;
  double error = 0;      // rms distance of the fitted points to the cap
  double area = 0;       // assigned surface area; the areas of all caps add up to the whole
  double weight = 1;     // factor of its blend weight
  double deviation = 0;  // largest distance of its surface from the tangent plane of the seed
};

// Lists the fields of Cap (fields.h), without its sphere and its support.
template <typename Visitor>
void visit_fields(FieldsOf<Cap>, const Visitor& field) {
  using C = Cap;
  field(&C::basis, {.name = "basis", .help = "set of harmonics of the cap: full or even"});
  field(&C::degree, {.name = "degree", .help = "highest degree of the cap"});
  field(&C::first,
        {.name = "first",
         .help = "index of the cap's first coefficient in the coefficients of the atlas"});
  field(&C::error, {.name = "error",
                    .help = "root mean square distance of the fitted points from the cap",
                    .unit = FieldUnit::kLength});
  field(&C::area,
        {.name = "area",
         .help =
             "area of the surface assigned to the cap; the areas of all caps add up to the whole"});
  field(&C::weight, {.name = "weight", .help = "factor of the blend weight of the cap"});
  field(&C::deviation,
        {.name = "deviation",
         .help = "largest distance of the cap's surface from the tangent plane at its seed",
         .unit = FieldUnit::kLength});
}

// Blend weight of a cap at s^2 < 1 of CapSupport. Both are multiplied by (1 - g^2 / T^2)^2 with the
// potential g and the band T. For noisy points a further factor is 1 / (1 + |grad r|^2 / r^2). It
// is the squared cosine of the angle between the cap's surface and its sphere, so that a cap that
// sees the surface obliquely counts less.
enum class CapBlend : std::uint8_t {
  kSmooth,  // (1 - s^2)^3
  kSpline   // the paper's quadratic B-spline of 3 s / 2 (P44)
};
EnumNames names_of(CapBlend blend);  // "smooth", "spline"

// Value of a cap outside of its points, for caps computed by integrals over their points.
enum class CapExtension : std::uint8_t {
  kZero,   // zero, as in the paper
  kSphere  // the sphere the cap lies on; the jump is only the cap's height above the sphere
};
EnumNames names_of(CapExtension extension);  // "zero", "sphere"

// The caps of a surface. Lengths are in the unit of the points.
struct Atlas {
  std::vector<Cap> caps;               // caps in any order
  std::vector<double> coefficients;    // coefficients of all caps, each starting at its Cap::first
  CapBlend blend = CapBlend::kSmooth;  // blend weights where supports overlap
  double spacing = 0;   // median point spacing, from the circle of nearest neighbours
  double noise = 0;     // standard deviation of the points' distances to the surface; 0 if clean
  double diagonal = 0;  // diagonal of the points' bounding box
  // Width in which the potentials of caps are averaged. A cap has a weight at grid points within
  // this distance of its surface, or within 2.5 steps of the grid if that is more.
  double band = 0;

  // Returns the coefficients of one of these caps; valid as long as the atlas.
  std::span<const double> coefficients_of(const Cap& cap) const {
    return {coefficients.data() + cap.first, n_coefficients(cap.basis, cap.degree)};
  }
};

// Returns the highest degree of all caps; 0 without caps.
int highest_degree(const Atlas& atlas);

// Potential of the surface according to one cap, and its gradient in space.
struct CapValue {
  // g = (|x - c| - r(u)) / sqrt(1 + |grad r|^2 / r^2): a signed distance to first order, positive
  // outside (method 7.5).
  double distance = 0;
  Vec3 gradient;       // gradient of g, to first order: a unit vector across the surface
  bool valid = false;  // false at the centre, behind it, and where r(u) <= 0
};
// Evaluates a cap with these coefficients at the point x, also where the cap has no weight.
CapValue evaluate(const Cap& cap, std::span<const double> coefficients, const Vec3& x);

}  // namespace rholm
