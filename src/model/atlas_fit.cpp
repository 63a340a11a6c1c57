#include "model/atlas_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/stopwatch.h"
#include "model/atlas_aims.h"
#include "model/atlas_pack.h"
#include "rholm/error.h"
#include "transform/cap_blend.h"
#include "transform/cap_prune.h"

namespace rholm {
namespace {

constexpr int kMostTries = 8;
constexpr double kWorthSearching = 1.5;  // tolerances: beyond, another aim comes first
// Where caps hardly agree, as between fingers, a grid may see a handle that another does not: other
// steps and bands, in these parts, are tried until the surface is connected as the shape is.
constexpr double kSteps[] = {1, 0.8};
constexpr double kBands[] = {1, 2, 1.5};
constexpr std::size_t kAnyHandles = std::numeric_limits<std::size_t>::max();

Atlas overlapping(Atlas atlas, const Overlap& overlap) {
  for (Cap& cap : atlas.caps) set_support(cap, overlap.reach * cap.frame.support);
  set_weights(atlas.caps, overlap.power);
  return atlas;
}

// As it comes out of the file.
Atlas rounded(Atlas atlas, const Overlap& overlap) {
  set_weights(atlas.caps, overlap.power);
  return unpack(pack(atlas), "");
}

// Of a grid, times the first choice.
struct GridParts {
  double step = 1, band = 1;
};
std::vector<GridParts> all_grid_parts() {
  std::vector<GridParts> parts;
  for (const double step : kSteps) {
    for (const double band : kBands) parts.push_back({step, band});
  }
  return parts;
}

// The surface of a model, what is measured on it, and how it hangs together.
struct TrialSurface {
  AtlasModel model;
  Topology topology;
  std::size_t odd = 0;  // parts and handles that the shape has not, or lacks
};

// Nothing of a surface with as many odd parts and handles as `too_many`: it is not measured.
std::optional<TrialSurface> try_surface(const FitTarget& target, AtlasModel model,
                                        const GridParts& parts, std::size_t too_many,
                                        const Context& context) {
  model.step *= parts.step, model.atlas.band *= parts.band;
  const Mesh mesh = synthesize(model, {}, context);
  TrialSurface trial{std::move(model), topology_of(inspect(mesh))};
  trial.odd = n_odd(trial.topology, target.topology);
  if (trial.odd >= too_many) return std::nullopt;
  trial.model.errors = target.measure(mesh);
  return trial;
}

// The surface of the first grid, or of another that is nearer to being right, tried in the order of
// `parts`: that grid comes first from then on.
TrialSurface search_grid(const FitTarget& target, const AtlasModel& model, TrialSurface best,
                         std::vector<GridParts>& parts, int& searches, const Context& context) {
  std::size_t best_at = 0;
  for (std::size_t i = 1; i < parts.size() && best.odd > 0; ++i) {
    if (i > 1 && best.odd > kFewHandles) break;
    try {
      std::optional<TrialSurface> trial = try_surface(target, model, parts[i], best.odd, context);
      if (trial) best = std::move(*trial), best_at = i;
    } catch (const Error& error) {
      // A finer grid than memory allows is no choice.
      if (error.code() != ErrorCode::kOutOfMemory) throw;
    }
  }
  const auto at = parts.begin() + static_cast<std::ptrdiff_t>(best_at);
  std::rotate(parts.begin(), at, at + 1);
  if (best.odd > 0 && best.odd <= kFewHandles) --searches;
  return best;
}

// Whether a trial is better than what there is: a tolerance kept first, then the handles, then few
// numbers, or the lesser error.
bool is_better(const TrialSurface& trial, bool met, const Compressed& than, std::size_t than_odd) {
  if (!than.model.errors) return true;
  if (met != than.report.met) return met;
  if (trial.odd != than_odd) return trial.odd < than_odd;
  return met ? size_of(trial.model.atlas).numbers() < size_of(than.model.atlas).numbers()
             : trial.model.errors->rms() < than.model.errors->rms();
}

}  // namespace

std::size_t n_odd(const Topology& found, const std::optional<Topology>& wanted) {
  if (!wanted) return 0;
  const auto between = [](std::size_t a, std::size_t b) { return std::max(a, b) - std::min(a, b); };
  return between(found.components, wanted->components) + between(found.genus, wanted->genus);
}

void fit_atlas(const FitTarget& target, const Atlas& chosen, const Overlap& overlap,
               Compressed& result, FitState& state, const Context& context) {
  CompressReport& report = result.report;
  const Atlas covered = overlapping(chosen, overlap);
  const PruneOptions wanted{.tolerance = target.tolerance,
                            .band = covered.band,
                            .stray = target.stray,
                            .max_degree = target.max_degree};
  std::optional<Pruning> pruning;
  Aims aims(target.tolerance, state.aim > 0 ? state.aim : target.tolerance);
  std::vector<GridParts> parts = all_grid_parts();
  for (int attempt = 0; attempt < kMostTries; ++attempt) {
    AtlasModel model = result.model;
    AimOutcome outcome;
    model.step = target.step;
    timed(report.times, "fit", [&] {
      if (!pruning) pruning.emplace(target.levels, wanted, covered, context);
      outcome.reached = pruning->to(aims.aim(), model.atlas, context).rms;
      model.atlas = rounded(std::move(model.atlas), overlap);
    });
    outcome.numbers = size_of(model.atlas).numbers();
    if (aims.is_old(outcome.numbers)) break;
    const TrialSurface trial = timed(report.times, "surface", [&] {
      TrialSurface first = *try_surface(target, model, parts.front(), kAnyHandles, context);
      const bool worth = first.model.errors->rms() <= kWorthSearching * target.tolerance;
      if (first.odd == 0 || !worth || state.searches == 0) return first;
      return search_grid(target, model, std::move(first), parts, state.searches, context);
    });
    outcome.rms = trial.model.errors->rms();
    outcome.met = outcome.rms <= target.accepted, outcome.odd = trial.odd > 0;
    if (is_better(trial, outcome.met, result,
                  n_odd({report.components, report.genus}, target.topology))) {
      result.model = trial.model;
      report.components = trial.topology.components, report.genus = trial.topology.genus;
      report.uncovered = target.uncovered;
      report.met = outcome.met, report.topology_kept = trial.odd == 0;
    }
    // No number is saved where more than the tolerance would do.
    const bool good = aims.is_close(outcome.rms) || target.tolerance < target.accepted;
    if (outcome.met && !outcome.odd && good) break;
    if (outcome.met && outcome.odd && !overlap.settles) {
      state.aim = std::min(aims.aim(), aims.corrected(outcome.rms));
      break;
    }
    if (trial.odd > kFewHandles && outcome.rms <= target.tolerance) break;
    if (!aims.advance(outcome)) break;
  }
}

}  // namespace rholm
