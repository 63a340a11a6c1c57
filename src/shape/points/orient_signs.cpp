#include "shape/points/orient_signs.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "shape/points/orient_field.h"
#include "shape/points/orient_graph.h"
#include "shape/points/orient_sides.h"

namespace rholm {
namespace {

// Share of the points where the winding number contradicts the graph. Measured
// (scripts/scan-figures) on twelve bodies, 1000 to 100 000 random points: at most 0.003 where fewer
// than one sign in a thousand is wrong, 0.02 ... 1 where more are.
constexpr double kDoubtful = 0.005;
constexpr int kCleanNeighbors = 10;
// Of so few points sheets are asked for before noise is believed; more are seldom so thin all over.
constexpr std::size_t kMostForSheets = 20000;
// Median residual of fits to one sheet, of their radius: up to 0.03 of clean points (twelve bodies,
// 1000 to 60 000 points), from 0.06 on with the least noise for which more neighbours are taken.
constexpr double kSheets = 0.04;
// That of directions with nothing to do with the points': a plane has a field along itself.
constexpr double kNoSheets = 0.5;
// Width of patches where the field is asked: half of the spacing tells thin sheets apart, of noisy
// points it has the signs of points off the surface wrong.
constexpr double kField = 0.5, kWideField = 1;
// What has no inside, a plane, is in doubt everywhere; there the graph is at least consistent.
constexpr double kClearly = 0.95;

// So many points share the disc of a fit. Noise is seen through by patches `spread` times as
// coarse.
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

// By the neighbours and the winding number, and the share of the points where the two disagree.
OrientSigns turn_by_graph(const OrientScene& scene, const Patches& patches, const LocalFits& fits,
                          double& doubtful, OrientReport& report, const Context& context) {
  OrientSigns signs{.normals = fits.normals};
  const OrientedParts parts = orient_along_graph(scene.points, fits, signs.normals);
  report_progress(context, "signs", 0.5);
  const SideTrust trust = turn_outwards(scene.points, patches, parts, signs.normals, context);
  report.components = parts.n_components;
  signs.agreement = mean_agreement(scene.points, fits, signs.normals);
  for (std::size_t i = 0; i < signs.agreement.size(); ++i) {
    signs.agreement[i] *= static_cast<float>(trust.of_component[parts.component[i]]);
  }
  doubtful = trust.doubtful;
  return signs;
}

// By the field of all points; `residual` is that of the fits then.
OrientSigns turn_by_field(const OrientScene& scene, const Patches& patches,
                          std::span<const Vec3> given, double width, LocalFits fits,
                          double& residual, const Context& context) {
  std::vector<Vec3> sheet =
      field_normals(*scene.tree, scene.points, patches.spacing, width, context);
  for (Vec3& n : sheet) n = normalized(n);
  // Where there are rows, the field tells those of other sheets from the next ones of this.
  SamplingGaps gaps;
  if (!scene.gaps.ratio.empty()) {
    gaps = find_gaps(*scene.tree, scene.points, sheet, context, RowsThatTurn::kCount);
  }
  residual = refit_on_sheets(*scene.tree, scene.points, gaps, sheet, fits, context);
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

// The field's, if they have to do with the fits and fewer of them are in doubt.
OrientSigns better(const OrientScene& scene, const Patches& patches, OrientSigns by_graph,
                   const OrientSigns& by_field, double residual, const Context& context) {
  const auto doubtful = [&](const OrientSigns& signs) {
    return doubtful_share(scene.points, patches, signs.normals, context);
  };
  if (residual > kNoSheets) return by_graph;
  return doubtful(by_field) <= kClearly * doubtful(by_graph) ? by_field : by_graph;
}

}  // namespace

OrientSigns find_signs(const OrientScene& scene, std::span<const Vec3> given, LocalFits& fits,
                       OrientReport& report, const Context& context) {
  const Patches fine = patches_of(fits, scene.gaps, 1);
  const Patches coarse = patches_of(
      fits, scene.gaps, std::sqrt(static_cast<double>(fits.n_neighbors) / kCleanNeighbors));
  const bool much_noise = fits.n_neighbors > kMostForCurvature;
  double in_doubt = 0;
  OrientSigns by_graph =
      turn_by_graph(scene, much_noise ? coarse : fine, fits, in_doubt, report, context);
  // The graph is right where the surface is sampled well and evenly.
  const bool sure = in_doubt <= kDoubtful && scene.gaps.ratio.empty();
  // Two sheets as near as the points of each look like noise, until the field tells them apart.
  const bool few = scene.points.size() <= kMostForSheets;
  double residual = 0;
  if (much_noise ? few : !sure) {
    LocalFits clean = fits;
    clean.n_neighbors = kCleanNeighbors;
    OrientSigns of_sheets = turn_by_field(scene, fine, given, kField, clean, residual, context);
    if (residual < kSheets) {
      fits.n_neighbors = kCleanNeighbors;
      return better(scene, fine, std::move(by_graph), of_sheets, residual, context);
    }
  }
  if (sure) return by_graph;
  OrientSigns by_field = turn_by_field(scene, coarse, given, kWideField, fits, residual, context);
  return better(scene, coarse, std::move(by_graph), by_field, residual, context);
}

}  // namespace rholm
