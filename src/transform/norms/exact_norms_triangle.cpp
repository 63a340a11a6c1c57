// Norms of faces that look large from the centre, one face at a time.
#include <algorithm>
#include <cmath>
#include <optional>

#include "shape/face.h"
#include "transform/norms/exact_norms.h"
#include "transform/norms/exact_norms_rules.h"

namespace rholm {
namespace {

// Squares of the corners' distances and of the edges opposite to the corners.
struct Squares {
  double r[3], l[3];
  double weight = 1;  // area of the piece, as a part of the whole face

  double center() const { return (r[0] + r[1] + r[2]) / 3 - (l[0] + l[1] + l[2]) / 9; }
};

Squares squares_of(const std::array<Vec3, 3>& p) {
  const Vec3 e0 = p[2] - p[1], e1 = p[0] - p[2], e2 = p[1] - p[0];
  return {.r = {dot(p[0], p[0]), dot(p[1], p[1]), dot(p[2], p[2])},
          .l = {dot(e0, e0), dot(e1, e1), dot(e2, e2)}};
}

// Returns <1/|x|> by the rule of degree 8.
double mean_of_inverse(const Squares& s) {
  const double g = s.center(), edges = s.l[0] + s.l[1] + s.l[2], corners = s.r[0] + s.r[1] + s.r[2];
  double sum = 0, weights = 0;
  for (const auto& [a, w] : kDegree8) {
    const double b = 1 - 2 * a;
    for (int i = 0; i < 3; ++i) {
      sum += w / std::sqrt(a * corners - a * b * edges + (b - a) * (s.r[i] + a * s.l[i]));
    }
    weights += 3 * w;
  }
  const auto& [a, b, w] = kDegree8Six;
  const double c = 1 - a - b;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const auto at = [&](double bj, double bk) {
      return a * s.r[i] + bj * s.r[j] + bk * s.r[k] - a * bj * s.l[k] - bj * bk * s.l[i] -
             bk * a * s.l[j];
    };
    sum += w / std::sqrt(at(b, c)) + w / std::sqrt(at(c, b));
  }
  weights += 6 * w;
  return sum + (1 - weights) / std::sqrt(g);
}

// Returns the halves on both sides of the median to edge k.
std::array<Squares, 2> halves(const Squares& s, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double middle = (s.r[i] + s.r[j]) / 2 - s.l[k] / 4;
  const double median = (s.l[i] + s.l[j]) / 2 - s.l[k] / 4;
  const auto half = [&](int from, int other) {
    return Squares{.r = {s.r[from], middle, s.r[k]},
                   .l = {median, s.l[other], s.l[k] / 4},
                   .weight = s.weight / 2};
  };
  return {half(i, j), half(j, i)};
}

// Returns <1/|x|> from pieces, which are halved along their longest edges until they are within the
// reach of the rule. Returns nothing if that takes too many pieces.
std::optional<double> mean_by_pieces(const Squares& whole) {
  constexpr int kMostPieces = 256;  // chosen: 30 us
  constexpr int kMostWaiting = 32;  // largest depth of halvings
  Squares waiting[kMostWaiting];
  int n = 0, pieces = 1;
  waiting[n++] = whole;
  double sum = 0;
  while (n > 0) {
    const Squares s = waiting[--n];
    const int longest = static_cast<int>(std::max_element(s.l, s.l + 3) - s.l);
    if (s.l[longest] <= kReach8 * s.center()) {
      sum += s.weight * mean_of_inverse(s);
      continue;
    }
    if (++pieces > kMostPieces || n + 2 > kMostWaiting) return std::nullopt;
    for (const Squares& half : halves(s, longest)) waiting[n++] = half;
  }
  return sum;
}

// Phi_T = sum_edges rho_e ln((R_1 + R_2 + len)/(R_1 + R_2 - len)) - d_T Omega_T is the potential of
// a plane polygon. This form of the logarithm of (M7) is stable on both sides of the foot of the
// perpendicular. `rounding` is the error in units of about 2^-53: rho_e is known to that part of R.
struct Potential {
  double value = 0, rounding = 0;
  void add(double factor, double uncertainty, double term) {
    value += factor * term;
    rounding += (std::abs(factor) + uncertainty) * std::abs(term);
  }
};

// Returns R_1 + R_2 - len, which vanishes with the distance of an edge from the centre.
double excess_of_path(double r1, double r2, double along, double across2, double length) {
  // (R_1 + R_2)^2 - len^2 = 2 (R_1 R_2 + p_1 . p_2), and
  // (R_1 R_2)^2 - (p_1 . p_2)^2 = |p_1 x p_2|^2.
  const double half = along >= 0 ? r1 * r2 + along : across2 / (r1 * r2 - along);
  return 2 * half / (r1 + r2 + length);
}

}  // namespace

NormSums norms_of_triangle(const std::array<Vec3, 3>& corners) {
  const std::array<Vec3, 3>& p = corners;
  const FaceNormal face = face_normal(p);
  if (face.degenerate) return {};
  const Squares s = squares_of(p);
  // The corner nearest to the centre loses least to rounding.
  const auto nearest = static_cast<std::size_t>(std::min_element(s.r, s.r + 3) - s.r);
  const double size = norm(face.twice_area), d2 = dot(face.twice_area, p[nearest]);
  const double d = d2 / size;
  const double r[3] = {std::sqrt(s.r[0]), std::sqrt(s.r[1]), std::sqrt(s.r[2])};
  // The formula is by Van Oosterom and Strackee 1983.
  const double solid_angle =
      2 * std::atan2(d2, r[0] * r[1] * r[2] + dot(p[0], p[1]) * r[2] + dot(p[1], p[2]) * r[0] +
                             dot(p[2], p[0]) * r[1]);
  Potential potential;
  potential.add(-d, 0, solid_angle);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const Vec3 e = p[j] - p[i], across = cross(p[i], e);
    const double length = norm(e), rho = dot(face.twice_area, across) / (size * length);
    const double excess = excess_of_path(r[i], r[j], dot(p[i], p[j]), dot(across, across), length);
    // rho ln(1/rho) vanishes with rho.
    if (rho != 0 && excess > 1e-300) potential.add(rho, r[i], std::log1p(2 * length / excess));
  }
  double mean = 2 * potential.value / size;
  constexpr double kLost = 100;  // chosen: a loss of 1e-14
  if (!(potential.rounding < kLost * potential.value)) {
    mean = mean_by_pieces(s).value_or(mean);
  }
  return {.first = d2 * mean, .third = 2 * solid_angle, .volume6 = d2};
}

}  // namespace rholm
