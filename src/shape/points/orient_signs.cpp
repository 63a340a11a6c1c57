#include "shape/points/orient_signs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "shape/points/local_shape.h"
#include "shape/points/orient_field.h"
#include "shape/points/orient_graph.h"
#include "shape/points/orient_rules.h"
#include "shape/points/orient_sides.h"

namespace rholm {
namespace {

// Up to this many points, thin sheets are tried before noise; larger clouds are seldom so thin.
constexpr std::size_t kMostForSheets = 20000;
// The kurtosis of heights is 3 for Gaussian noise, 1.8 for a filled slab and 1 for two sheets.
constexpr double kSheetKurtosis = 2;

// Returns true if the heights of some neighbourhoods have two peaks.
bool may_be_sheets(const OrientScene& scene, int n_neighbors, const Context& context) {
  for (const int part : {1, 2, 4, 8}) {
    const auto k = static_cast<std::size_t>(n_neighbors / part);
    if (kurtosis_of_heights(*scene.tree, scene.points, k, context) < kSheetKurtosis) return true;
  }
  return false;
}

// Computes signs by neighbours and winding number, and the share of points where these disagree.
OrientSigns turn_by_graph(std::span<const Vec3> points, const Patches& patches,
                          const LocalFits& fits, double& doubtful, OrientReport& report,
                          const Context& context) {
  OrientSigns signs{.normals = fits.normals};
  const OrientedParts parts = orient_along_graph(points, fits, signs.normals);
  report_progress(context, "signs", 0.5);
  const SideTrust trust = turn_outwards(points, patches, parts, signs.normals, context);
  report.components = parts.n_components;
  signs.agreement = mean_agreement(points, fits, signs.normals);
  for (std::size_t i = 0; i < signs.agreement.size(); ++i) {
    signs.agreement[i] *= static_cast<float>(trust.of_component[parts.component[i]]);
  }
  doubtful = trust.doubtful;
  return signs;
}

// Computes signs by the field of all points; `residual` is the median residual of the new fits.
OrientSigns turn_by_field(const OrientScene& scene, const Patches& patches,
                          std::span<const Vec3> given, double width, LocalFits fits,
                          double& residual, const Context& context) {
  std::vector<Vec3> sheet =
      field_normals(*scene.tree, scene.points, patches.spacing, width, context);
  for (Vec3& n : sheet) n = normalized(n);
  // In rows, the field distinguishes rows of other sheets from the next rows of the same sheet.
  SamplingGaps gaps;
  if (!scene.gaps.ratio.empty()) {
    gaps = find_gaps(*scene.tree, scene.points, sheet, context, RowsThatTurn::kCount);
  }
  std::vector<float> residuals =
      refit_on_sheets(*scene.tree, scene.points, gaps, sheet, fits, context);
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 2);
  std::nth_element(residuals.begin(), middle, residuals.end());
  residual = *middle;
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (norm(given[i]) > 0) fits.normals[i] = dot(given[i], sheet[i]) < 0 ? -given[i] : given[i];
  }
  OrientSigns signs{.normals = std::move(fits.normals)};
  signs.agreement = mean_agreement(scene.points, fits, signs.normals);
  const std::vector<double> trust = trust_in_sides(scene.points, patches, signs.normals, context);
  for (std::size_t i = 0; i < trust.size(); ++i) {
    signs.agreement[i] *= static_cast<float>(trust[i]);
  }
  return signs;
}

// Returns the field's signs if they fit the points and fewer of them are contradicted.
OrientSigns better(const OrientScene& scene, const Patches& patches, OrientSigns by_graph,
                   const OrientSigns& by_field, double residual, const Context& context) {
  const auto doubtful = [&](const OrientSigns& signs) {
    return doubtful_share(scene.points, patches, signs.normals, context);
  };
  if (residual > kNoSheets) return by_graph;
  return doubtful(by_field) <= kClearly * doubtful(by_graph) ? by_field : by_graph;
}

}  // namespace

Patches patches_of(const LocalFits& fits, const SamplingGaps& gaps, double spread) {
  const std::size_t n = fits.radius.size();
  Patches patches{std::vector<double>(n), std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    const double radius = fits.radius[i];
    patches.areas[i] = std::numbers::pi * radius * radius /
                       (static_cast<double>(gaps.scaled(i, fits.n_neighbors)) + 0.5);
    patches.spacing[i] = spread * std::sqrt(gaps.of(i) * patches.areas[i]);
  }
  return patches;
}

double spread_of(int n_neighbors) {
  return std::sqrt(static_cast<double>(n_neighbors) / kCleanNeighbors);
}

double spread_of_graph(int n_neighbors) {
  return n_neighbors > kMostForCurvature ? spread_of(n_neighbors) : 1;
}

// Agreements of 0.15, 0.25, 0.35, 0.45, 0.55, 0.65 have 0.034, 0.032, 0.009, 0.003, 0.001, 0.0008
// wrong signs, of 2.4 million points of sixty inputs (scripts/scan-figures). The formula gives
// shares of 0.11, 0.04, 0.015, 0.006, 0.002, 0.0008.
double confidence_of(double agreement) { return 1 - std::exp(-10 * agreement); }

OrientSigns find_signs(const OrientScene& scene, std::span<const Vec3> given, LocalFits& fits,
                       OrientReport& report, const Context& context) {
  const Patches fine = patches_of(fits, scene.gaps, 1);
  const Patches coarse = patches_of(fits, scene.gaps, spread_of(fits.n_neighbors));
  // Settled points are nearer to the surface than noise, by about this factor.
  constexpr double kSettled = 3;
  const Patches settled = patches_of(fits, scene.gaps, spread_of(fits.n_neighbors) / kSettled);
  const bool much_noise = fits.n_neighbors > kMostForCurvature;
  // A point far off the surface would be on the wrong side of it.
  const std::span<const Vec3> points = fits.settled.empty() ? scene.points : fits.settled;
  double in_doubt = 0;
  OrientSigns by_graph = turn_by_graph(points,
                                       !much_noise            ? fine
                                       : fits.settled.empty() ? coarse
                                                              : settled,
                                       fits, in_doubt, report, context);
  // The graph is right if the surface is sampled well and evenly.
  const bool sure = in_doubt <= kDoubtfulGraph && scene.gaps.ratio.empty();
  // Two sheets as near as the points of each look like noise, until the field separates them.
  const bool two_peaks = much_noise && may_be_sheets(scene, fits.n_neighbors, context);
  const bool few = two_peaks || scene.points.size() <= kMostForSheets;
  double residual = 0;
  if (much_noise ? few : !sure) {
    LocalFits clean = fits;
    clean.n_neighbors = kCleanNeighbors;
    OrientSigns of_sheets = turn_by_field(scene, fine, given, kField, clean, residual, context);
    if (residual < kSheets) {
      fits.n_neighbors = kCleanNeighbors;
      if (two_peaks) return of_sheets;
      return better(scene, fine, std::move(by_graph), of_sheets, residual, context);
    }
  }
  // Points that were settled need no field; its solution among far scattered points takes minutes.
  if (sure || !fits.settled.empty()) return by_graph;
  OrientSigns by_field = turn_by_field(scene, coarse, given, kWideField, fits, residual, context);
  return better(scene, coarse, std::move(by_graph), by_field, residual, context);
}

}  // namespace rholm
