// Random points need no smoothness. Unlike in the cubature of the curl method, no face near the
// axis is left out, and the integral of (M2) may start anywhere.
//
// F_theta = -Pbar_lm(cos theta) sin(theta) int_start^phi r e^{-i m phi'} dphi'. Stokes' theorem
// only needs an antiderivative along each parallel within the face: `start` may be any function of
// theta. (M2) starts at the foot of the normal, where the path is safe. On a rough surface the foot
// is far from the face. The field and its scatter are then as large as r, not r times the face's
// width. The middle of the face's longitudes is near. If the parallel leaves the half space of the
// face before this middle, the point nearest to the foot of the normal is taken. It is between the
// foot and all points of the face.
#include "paper/monte_carlo/edge_terms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "paper/methods/curl_integrals.h"

namespace rholm {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;

double wrapped(double angle) { return angle - 2 * kPi * std::round(angle / (2 * kPi)); }

double cross_xy(const Vec3& a, const Vec3& b) { return a.x * b.y - a.y * b.x; }
double dot_xy(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y; }

// Sets the range of longitudes, at most pi, of a triangle without the axis in its interior. Corners
// on the axis have no longitude.
void set_longitudes(const std::array<Vec3, 3>& p, FieldFace& face) {
  face.phi_half = -1;
  int opposite = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3];
    if (dot_xy(a, a) == 0 || dot_xy(b, b) == 0) continue;
    const double turn = std::atan2(cross_xy(a, b), dot_xy(a, b));
    if (std::abs(turn) / 2 <= face.phi_half) continue;
    face.phi_half = std::abs(turn) / 2;
    face.phi_middle = std::atan2(a.y, a.x) + turn / 2;
    opposite = (i + 2) % 3;
  }
  // For an edge that nearly meets the axis, rounding decides on which side it passes. The third
  // corner then corrects the side.
  const Vec3& third = p[opposite];
  if (face.phi_half > 1.5 && dot_xy(third, third) > 0) {
    const double away = wrapped(std::atan2(third.y, third.x) - face.phi_middle);
    if (std::abs(away) > kPi / 2) face.phi_middle += kPi;
  }
}

FieldFace field_face(const std::array<Vec3, 3>& p, const FaceGeometry& geometry) {
  FieldFace face;
  if (geometry.degenerate || geometry.d == 0) return face;
  // A face that turns inwards has the same radius d/(n.u) with both signs changed; the direction of
  // its boundary makes it count negative.
  const double side = geometry.d < 0 ? -1 : 1;
  face.n = (side / norm(geometry.twice_area)) * geometry.twice_area;
  face.d = side * geometry.d;
  face.slant = std::hypot(face.n.x, face.n.y);
  face.phi_n = face.slant > 0 ? std::atan2(face.n.y, face.n.x) : 0.0;
  face.turn = std::polar(1.0, -face.phi_n);
  for (const Vec3& corner : p) face.largest_radius = std::max(face.largest_radius, norm(corner));
  set_longitudes(p, face);
  if (face.phi_half < 0) face.d = 0;  // two corners on the axis: seen edge on
  return face;
}

// Returns true if the axis is in the interior, with `shares` of the corners at the pole.
bool contains_axis(const std::array<Vec3, 3>& p, std::array<double, 3>& shares) {
  for (int i = 0; i < 3; ++i) shares[i] = cross_xy(p[(i + 1) % 3], p[(i + 2) % 3]);
  const double sum = shares[0] + shares[1] + shares[2];
  const bool inside = (shares[0] > 0 && shares[1] > 0 && shares[2] > 0) ||
                      (shares[0] < 0 && shares[1] < 0 && shares[2] < 0);
  for (double& share : shares) share /= sum;
  return inside;
}

// Adds the faces at the three sides of a triangle; side i begins at corner i.
using SideFaces = std::array<int, 3>;

SideFaces add_faces(const std::array<Vec3, 3>& p, const FaceGeometry& geometry, FieldEdges& field) {
  const auto add = [&](const std::array<Vec3, 3>& corners) {
    const FieldFace face = field_face(corners, geometry);
    if (face.d == 0) return -1;
    field.faces.push_back(face);
    return static_cast<int>(field.faces.size()) - 1;
  };
  std::array<double, 3> shares{};
  if (geometry.degenerate || geometry.d == 0 || !contains_axis(p, shares)) {
    const int face = add(p);
    return {face, face, face};
  }
  const Vec3 pole = {0, 0, shares[0] * p[0].z + shares[1] * p[1].z + shares[2] * p[2].z};
  SideFaces sides{};
  for (int i = 0; i < 3; ++i) sides[i] = add({pole, p[i], p[(i + 1) % 3]});
  for (int i = 0; i < 3; ++i) {
    field.edges.push_back(
        {.a = pole, .along = p[i] - pole, .left = sides[i], .right = sides[(i + 2) % 3]});
  }
  return sides;
}

int side_of(const Triangle& triangle, std::uint32_t from, std::uint32_t to) {
  for (int i = 0; i < 3; ++i) {
    if (triangle[i] == from && triangle[(i + 1) % 3] == to) return i;
  }
  return 0;  // not reached: the edge belongs to the triangle
}

// A parallel in the terms of a face.
struct Parallel {
  double C = 0, rho = 0;  // coefficients in (M2)
  double value(double psi) const { return C + rho * std::cos(psi); }
};

double start_of(const FieldFace& face, const Parallel& at, double psi_middle) {
  // If C + rho cos(psi) is below this, the plane there is more than 2 largest_radius away.
  const double least = face.d / (2 * face.largest_radius);
  const double nearest = std::clamp(0.0, psi_middle - face.phi_half, psi_middle + face.phi_half);
  for (const double psi : {psi_middle, nearest}) {
    if (at.value(psi) >= least) return at.C > at.rho ? psi : wrapped(psi);
  }
  return 0;
}

Complex over_i(const Complex& z) { return {z.imag(), -z.real()}; }

// Evaluates (M3) from `from` to `to`, where curl_integrals.cpp starts at 0. K_m of both ends obey
// the same recurrence, and so does their difference, with
//   E_m = (e^{-i m from} - e^{-i m to}) / (i m).
class FieldIntegrals {
 public:
  FieldIntegrals(const Parallel& at, double from, double to, double end_value)
      : at_(at),
        range_(to - from),
        end_value_(end_value),
        from_value_(at.value(from)),
        turn_from_(std::polar(1.0, -from)),
        turn_to_(std::polar(1.0, -to)),
        zero_(curl_integral_of_order_zero(at.C, at.rho, to, end_value) -
              curl_integral_of_order_zero(at.C, at.rho, from, from_value_)) {}

  void fill(std::span<Complex> out, FieldScratch& scratch) const {
    const double size = static_cast<double>(out.size());
    double log_lambda = 0;
    if (at_.C > at_.rho) {
      log_lambda =
          at_.rho > 0
              ? std::log((at_.C + std::sqrt((at_.C - at_.rho) * (at_.C + at_.rho))) / at_.rho)
              : INFINITY;
    }
    // The forward recurrence amplifies rounding by e^12 = 2e5, to 1e-11, far below the scatter.
    if (size * log_lambda < 12) {
      run_forward(out);
    } else {
      solve_tridiagonal(log_lambda, out, scratch);
    }
  }

 private:
  void run_forward(std::span<Complex> out) const {
    out[0] = zero_;
    if (out.size() == 1) return;
    out[1] = Complex(range_ - at_.C * zero_, std::log(end_value_ / from_value_)) / at_.rho;
    Complex low = turn_from_, high = turn_to_;
    const double over_rho = 2 / at_.rho;
    for (std::size_t m = 1; m + 1 < out.size(); ++m) {
      const Complex right = over_i(low - high) / static_cast<double>(m);
      out[m + 1] = (right - at_.C * out[m]) * over_rho - out[m - 1];
      low *= turn_from_;
      high *= turn_to_;
    }
  }

  void solve_tridiagonal(double log_lambda, std::span<Complex> out, FieldScratch& scratch) const {
    const std::size_t last = out.size() - 1;
    // The asymptotics at the far end have a relative error of 1, which reaches `last` times e^-30.
    const std::size_t end = last + 2 + static_cast<std::size_t>(std::ceil(30 / log_lambda));
    std::vector<double>& upper = scratch.upper;
    std::vector<Complex>& value = scratch.value;
    upper.assign(end, 0.0);
    value.assign(end, 0.0);
    const double off = at_.rho / 2;
    Complex low = turn_from_, high = turn_to_;
    for (std::size_t m = 1; m < end; ++m) {
      Complex right = over_i(low - high) / static_cast<double>(m);
      low *= turn_from_;
      high *= turn_to_;
      if (m == 1) right -= off * zero_;
      if (m == end - 1) {
        right -= off * over_i(low / from_value_ - high / end_value_) / static_cast<double>(end);
      }
      const double pivot = 1 / (at_.C - off * upper[m - 1]);
      upper[m] = off * pivot;
      value[m] = (right - off * value[m - 1]) * pivot;
    }
    Complex next = 0;
    for (std::size_t m = end - 1; m >= 1; --m) {
      next = value[m] - upper[m] * next;
      if (m <= last) out[m] = next;
    }
    out[0] = zero_;
  }

  Parallel at_;
  double range_, end_value_, from_value_;
  Complex turn_from_, turn_to_;
  double zero_;
};

// Adds factor d e^{-i m phi_n} K_m of a face at direction u and radius r.
void add_face_terms(const FieldFace& face, const Vec3& u, double r, double factor, FieldStart start,
                    std::span<Complex> terms, FieldScratch& scratch) {
  const Parallel at = {.C = face.n.z * u.z, .rho = face.slant * std::hypot(u.x, u.y)};
  if (!(at.C + at.rho > 0)) return;  // due to rounding: the pole on a face seen edge on
  const double psi_middle = wrapped(face.phi_middle - face.phi_n);
  double psi = psi_middle + wrapped(std::atan2(u.y, u.x) - face.phi_middle);
  // For C <= rho the half space is an interval around psi = 0 that does not reach +-pi.
  if (at.C <= at.rho) psi = wrapped(psi);
  const double from = start == FieldStart::kFace ? start_of(face, at, psi_middle) : 0.0;
  std::vector<Complex>& k = scratch.k;
  k.resize(terms.size());
  FieldIntegrals(at, from, psi, face.d / r).fill(k, scratch);
  Complex phase = factor * face.d;
  for (std::size_t m = 0; m < terms.size(); ++m) {
    terms[m] += phase * k[m];
    phase *= face.turn;
  }
}

}  // namespace

FieldEdges field_edges(const StarGeometry& geometry) {
  FieldEdges field;
  std::vector<SideFaces> sides;
  sides.reserve(geometry.faces.size());
  for (std::size_t t = 0; t < geometry.faces.size(); ++t) {
    sides.push_back(add_faces(geometry.corners(t), geometry.faces[t], field));
  }
  const std::vector<Triangle>& triangles = geometry.chart->mesh.faces;
  for (const Edge& edge : geometry.chart->edges) {
    const Vec3 &a = geometry.vertices[edge.a], &b = geometry.vertices[edge.b];
    const int left = sides[edge.left][side_of(triangles[edge.left], edge.a, edge.b)];
    const int right = sides[edge.right][side_of(triangles[edge.right], edge.b, edge.a)];
    if (left < 0 && right < 0) continue;
    field.edges.push_back({.a = a, .along = b - a, .left = left, .right = right});
  }
  return field;
}

Vec3 field_at(const FieldEdges& field, const FieldEdge& edge, double t, FieldStart start,
              std::span<Complex> terms, FieldScratch& scratch) {
  const Vec3 x = edge.a + t * edge.along;
  const double r = norm(x);
  const Vec3 u = x / r;
  // -sin(theta) dtheta = d(u_z): (M1) is +Pbar d e^{-i m phi_n} K_m d(u_z).
  const double climb = (edge.along.z - u.z * dot(u, edge.along)) / r;
  std::fill(terms.begin(), terms.end(), Complex(0));
  if (edge.left >= 0) add_face_terms(field.faces[edge.left], u, r, climb, start, terms, scratch);
  if (edge.right >= 0) add_face_terms(field.faces[edge.right], u, r, -climb, start, terms, scratch);
  // f is real: C_lm belongs to the real part, S_lm to minus the imaginary part.
  for (Complex& term : terms) term = std::conj(term);
  return u;
}

}  // namespace rholm
