// Normals where two sheets are close: fits to the neighbours on one of them.
#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "shape/points/normals.h"
#include "shape/points/plane_fit.h"

namespace rholm {
namespace {

// Neighbours are on one sheet where the field's directions agree within 53 degrees. Of 0, 0.3, 0.6,
// 0.7 and 0.8 this does best on twelve bodies of 1000 points.
constexpr double kSameSheet = 0.6;
// Residual of clean points, of the radius, below which the fit and not the field has the direction
// (0.02 ... 0.1: the less the better on 1000 points, all are alike on more), and the cosine between
// them.
constexpr double kGoodFit = 0.02;
constexpr double kAgree = 0.5;
// Times those of a fit: the most that are asked for, and the share of a fit that is enough.
constexpr std::size_t kMost = 4;
constexpr double kEnough = 0.7;
constexpr std::size_t kFewest = 6;  // as many as a paraboloid has coefficients
constexpr double kWidth = 0.01;     // of the length squared: less is a line

// The nearest k on the sheet of point i; fewer where there are.
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
      // Six points have a paraboloid through them.
      const auto m = static_cast<double>(near.points.size());
      residuals[i] = static_cast<float>(fit.residual * std::sqrt(m / (m - 5.9)));
      if (curved && fit.residual > kGoodFit) continue;
      fits.normals[i] = cosine > 0 ? fit.normal : -fit.normal;
    }
  });
  return residuals;
}

}  // namespace rholm
