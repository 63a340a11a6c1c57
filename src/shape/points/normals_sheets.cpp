// Computes normals where two sheets are close, by fits to the neighbours on one sheet.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "shape/points/normals.h"
#include "shape/points/plane_fit.h"

namespace rholm {
namespace {

// Neighbours are on one sheet if their directions in the field agree within 53 degrees. Among 0,
// 0.3, 0.6, 0.7 and 0.8, this cosine is best on twelve bodies of 1000 points.
constexpr double kSameSheet = 0.6;
// Largest residual, relative to the radius, of a fit that replaces the field's direction. From 0.02
// to 0.1, smaller is better on 1000 points, and all values are equal on more points. kAgree is the
// least cosine between the two directions.
constexpr double kGoodFit = 0.02;
constexpr double kAgree = 0.5;
// Largest and sufficient number of neighbours, relative to the number of a fit.
constexpr std::size_t kMost = 4;
constexpr double kEnough = 0.7;
constexpr std::size_t kFewest = 6;  // number of coefficients of a paraboloid
constexpr double kWidth = 0.01;     // of the squared length: a narrower set is a line

// Finds the nearest k neighbours on the sheet of point i, or fewer if there are not enough.
void gather_sheet(const PointTree& tree, std::span<const Vec3> points, std::span<const Vec3> sheet,
                  std::size_t i, std::size_t k, Neighborhood& near) {
  for (std::size_t asked = k;; asked *= 2) {
    near.gather(tree, points, i, asked);
    std::size_t kept = 0;
    for (std::size_t j = 0; j < near.found.size() && kept <= k; ++j) {
      if (!(dot(sheet[near.found[j].index], sheet[i]) > kSameSheet)) continue;
      near.points[kept] = near.points[j];
      near.weights[kept++] = near.weights[j];
    }
    near.points.resize(kept), near.weights.resize(kept);
    const bool enough = static_cast<double>(kept) > kEnough * static_cast<double>(k);
    if (enough || asked >= kMost * k || near.found.size() == points.size()) return;
  }
}

}  // namespace

std::vector<float> refit_on_sheets(const PointTree& tree, std::span<const Vec3> points,
                                   const SamplingGaps& gaps, std::span<const Vec3> sheet,
                                   LocalFits& fits, const Context& context) {
  const bool curved = fits.n_neighbors <= kMostForCurvature;
  std::vector<float> residuals(points.size(), 1.0f);
  parallel_for(points.size(), 256, context, {}, [&](std::size_t begin, std::size_t end) {
    Neighborhood near;
    for (std::size_t i = begin; i < end; ++i) {
      fits.normals[i] = sheet[i];
      gather_sheet(tree, points, sheet, i, gaps.scaled(i, fits.n_neighbors), near);
      if (near.points.size() < kFewest || !(near.radius > 0)) continue;
      const PlaneFit plane = fit_plane(near.points, near.weights);
      if (!(plane.width > kWidth * plane.length)) continue;
      ParaboloidFit fit = fit_paraboloid(near.points, near.weights, plane.normal);
      if (!curved) fit.normal = plane.normal;
      const double cosine = dot(fit.normal, sheet[i]);
      if (std::abs(cosine) < kAgree) continue;
      // Six points always have a paraboloid through them.
      const auto m = static_cast<double>(near.points.size());
      residuals[i] = static_cast<float>(fit.residual * std::sqrt(m / (m - 5.9)));
      if (curved && fit.residual > kGoodFit) continue;
      fits.normals[i] = cosine > 0 ? fit.normal : -fit.normal;
    }
  });
  return residuals;
}

}  // namespace rholm
