#include "model/atlas/atlas_fit.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "atlas/cap/cap_support.h"
#include "atlas/few/cap_blend.h"
#include "atlas/few/cap_prune.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "model/atlas/atlas_aims.h"
#include "model/file/atlas_pack.h"
#include "rholm/error.h"

namespace rholm {
namespace {

constexpr int kMostTries = 8;            // aims, for each overlap
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
  std::size_t wrong = 0;  // parts and handles
};

// Lower is better: first a tolerance that is kept, then the handles, then few numbers; where the
// tolerance is missed, right handles, then the error.
using Rank = std::tuple<bool, std::size_t, double>;
Rank rank(const AtlasModel& model, std::size_t wrong, double accepted) {
  const double rms = model.errors->rms();
  if (rms > accepted) return {true, wrong > 0, rms};
  return {false, wrong, static_cast<double>(size_of(model.atlas).numbers())};
}

// Nothing of a surface with `too_many` wrong handles or more: it is not measured.
std::optional<TrialSurface> try_surface(const FitTarget& target, AtlasModel model,
                                        const GridParts& parts, std::size_t too_many) {
  model.step *= parts.step, model.atlas.band *= parts.band;
  const Mesh mesh = target.surface(model);
  TrialSurface trial{std::move(model), topology_of(inspect(mesh))};
  trial.wrong = n_wrong_handles(trial.topology, target.topology);
  if (trial.wrong >= too_many) return std::nullopt;
  trial.model.errors = target.measure(mesh);
  return trial;
}

// The surface of the first grid, or a better one of another, tried in the order of `parts`: that
// grid comes first from then on. Of a surface with many wrong handles only the next grid is tried.
TrialSurface search_grid(const FitTarget& target, const AtlasModel& model, TrialSurface best,
                         std::vector<GridParts>& parts, int& searches) {
  std::size_t best_at = 0;
  for (std::size_t i = 1; i < parts.size() && best.wrong > 0; ++i) {
    if (i > 1 && best.wrong > kFewHandles) break;
    try {
      std::optional<TrialSurface> trial = try_surface(target, model, parts[i], best.wrong);
      if (!trial || rank(trial->model, trial->wrong, target.accepted) >=
                        rank(best.model, best.wrong, target.accepted)) {
        continue;
      }
      best = std::move(*trial), best_at = i;
    } catch (const Error& error) {
      // A finer grid than memory allows is no choice.
      if (error.code() != ErrorCode::kOutOfMemory) throw;
    }
  }
  const auto at = parts.begin() + static_cast<std::ptrdiff_t>(best_at);
  std::rotate(parts.begin(), at, at + 1);
  if (best.wrong > 0 && best.wrong <= kFewHandles) --searches;
  return best;
}

}  // namespace

std::size_t n_wrong_handles(const Topology& found, const std::optional<Topology>& wanted) {
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
    if (aims.repeats(outcome.numbers)) break;
    std::optional<TrialSurface> trial;
    try {
      trial = timed(report.times, "surface", [&] {
        TrialSurface first = *try_surface(target, model, parts.front(), kAnyHandles);
        const bool worth = first.model.errors->rms() <= kWorthSearching * target.tolerance;
        if (first.wrong == 0 || !worth || state.searches == 0) return first;
        return search_grid(target, model, std::move(first), parts, state.searches);
      });
    } catch (const Error& error) {
      // No surface, or none that memory allows: what there is already stands.
      const bool none =
          error.code() == ErrorCode::kInvalidInput || error.code() == ErrorCode::kOutOfMemory;
      if (!none || !result.model.errors) throw;
      break;
    }
    outcome.rms = trial->model.errors->rms();
    outcome.met = outcome.rms <= target.accepted, outcome.whole = trial->wrong == 0;
    const std::size_t wrong = n_wrong_handles({report.components, report.genus}, target.topology);
    if (!result.model.errors || rank(trial->model, trial->wrong, target.accepted) <
                                    rank(result.model, wrong, target.accepted)) {
      result.model = trial->model;
      report.components = trial->topology.components, report.genus = trial->topology.genus;
      report.uncovered = target.uncovered;
      report.met = outcome.met, report.topology_kept = outcome.whole;
    }
    // No number is saved where more than the tolerance would do.
    const bool good = aims.is_close(outcome.rms) || target.tolerance < target.accepted;
    if (outcome.met && outcome.whole && good) break;
    if (outcome.met && !outcome.whole && !overlap.settles) {
      state.aim = std::min(aims.aim(), aims.corrected(outcome.rms));
      break;
    }
    // (Farther than aimed at, they may be due to that.)
    if (trial->wrong > kFewHandles && outcome.rms <= target.tolerance) break;
    if (!aims.advance(outcome)) break;
  }
}

}  // namespace rholm
