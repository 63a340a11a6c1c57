// An upper bound of the largest radial error of an expansion over the whole surface, proven by
// branch and bound. Slow: for low degrees and few faces.
//
// Within an angle h of a direction u on one face, for e = r - r_L,
//   |e| <= |e(u)| + h |grad e(u)| + h^2/2 (M_r + M_L).
// M_L bounds second derivatives of r_L along great circles. On one, the terms of degree l are a
// trigonometric polynomial of that degree, whose second derivative is at most l^2 times its largest
// value (Bernstein), and that is at most sqrt((2l + 1)/4 pi) times the norm of the terms. M_r does
// the same for r = d/c of the plane, c being the cosine between u and its normal: r'' <= r (2/c^2 -
// 1).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/harmonic.h"
#include "rholm/mesh.h"

namespace rholm::test {

// A part of the plane of a face.
struct BoundCell {
  std::array<Vec3, 3> corners;
  Vec3 normal;  // of the plane, a unit vector
};

inline double second_derivative_bound(const Coefficients& c) {
  const std::vector<double> energies = power_spectrum(c);
  double sum = 0;
  for (std::size_t l = 0; l < energies.size(); ++l) {
    const auto degree = static_cast<double>(l);
    sum += degree * degree * std::sqrt((2 * degree + 1) / (4 * std::numbers::pi) * energies[l]);
  }
  return sum;
}

struct ErrorBound {
  double bound = 0;       // no error is larger
  std::size_t cells = 0;  // that were looked at
};
// About the origin. Parts of faces are divided until none may have an error above `enough`, or
// until `most_cells` were looked at: then the bound is larger than that.
inline ErrorBound largest_error_bound(const Mesh& mesh, const Coefficients& c, double enough,
                                      std::size_t most_cells) {
  const double model_bend = second_derivative_bound(c);
  std::vector<BoundCell> cells;
  cells.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    BoundCell cell{{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, {}};
    const auto& p = cell.corners;
    cell.normal = normalized(cross(p[1] - p[0], p[2] - p[0]));
    cells.push_back(cell);
  }
  ErrorBound result{.bound = enough, .cells = 0};
  while (!cells.empty()) {
    std::vector<Vec3> directions;
    directions.reserve(cells.size());
    for (const BoundCell& cell : cells) {
      directions.push_back(normalized(cell.corners[0] + cell.corners[1] + cell.corners[2]));
    }
    const ValuesAndGradients model = evaluate_with_gradient(c, directions);
    result.cells += cells.size();
    std::vector<BoundCell> open;
    double highest = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto& [p, n] = cells[i];
      const Vec3& u = directions[i];
      // The part lies within the cap around its corners.
      double h = 0;
      for (const Vec3& x : p) h = std::max(h, std::atan2(norm(cross(u, x)), dot(u, x)));
      const double d = dot(n, p[0]), cosine = dot(n, u);
      const double least = std::cos(std::min(std::acos(std::min(1.0, cosine)) + h, 1.6));
      double bound = std::numeric_limits<double>::infinity();
      if (least > 0) {
        const double r = d / cosine;
        const Vec3 slope = -r / cosine * (n - cosine * u) - model.gradients[i];
        const double bend = d / least * (2 / (least * least) - 1) + model_bend;
        bound = std::abs(r - model.values[i]) + h * norm(slope) + h * h / 2 * bend;
      }
      if (bound <= enough) continue;
      highest = std::max(highest, bound);
      const Vec3 a = (p[0] + p[1]) / 2, b = (p[1] + p[2]) / 2, e = (p[2] + p[0]) / 2;
      for (const std::array<Vec3, 3>& part :
           {std::array{p[0], a, e}, {a, p[1], b}, {e, b, p[2]}, {a, b, e}}) {
        open.push_back({part, n});
      }
    }
    if (result.cells + open.size() > most_cells) {
      result.bound = std::max(enough, highest);
      return result;
    }
    cells = std::move(open);
  }
  return result;
}

}  // namespace rholm::test
