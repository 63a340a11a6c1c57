#include "model/atlas/atlas_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "atlas/cap/cap_support.h"
#include "atlas/compress/cap_blend.h"
#include "atlas/compress/cap_prune.h"
#include "base/parallel.h"
#include "base/stopwatch.h"
#include "reconstruct/file/atlas_pack.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Fractions of the tolerance: the target of the next aim, and the error that ends the search.
constexpr double kAim = 0.995, kGoodEnough = 0.97;
// An aim is the last if the surface's log(rms) changes by less than this part of log(aim)'s change.
constexpr double kStalled = 0.1;
// The search ends if the aims that keep and exceed the tolerance have a ratio below kSameAim, or
// their numbers below kSameNumbers. kGoodEnough gives away as much.
constexpr double kSameAim = 1.03, kSameNumbers = 1.03;
// While handles are wrong the aim is multiplied by kTighter, at most kTightenings times: half the
// tolerance in all. Three of the meshes 15, 38, 51, 61, 111, 115, 138, 338 and 460 of
// tests/cli/random_meshes.py became right in this way, none by a looser aim.
constexpr double kTighter = 0.7;
constexpr int kTightenings = 2;

}  // namespace

double Aims::corrected(double rms) const { return aim_ * kAim * tolerance_ / rms; }

bool Aims::is_close(double rms) const { return rms >= kGoodEnough * tolerance_; }

bool Aims::is_stalled(const AimOutcome& outcome) const {
  if (outcome.met || last_.rms <= tolerance_) return outcome.numbers == last_.numbers;
  return std::log(outcome.rms / last_.rms) > kStalled * std::log(aim_ / last_aim_);
}

void Aims::remember(const AimOutcome& outcome) { last_ = outcome, last_aim_ = aim_; }

bool Aims::advance(const AimOutcome& outcome) {
  const bool near = outcome.rms <= tolerance_;
  // If hardly any coefficient was left to drop, the error of the samples is below the aim. The next
  // aim must then be below this error.
  if (!outcome.met && kept_ == 0) aim_ = std::min(aim_, outcome.reached);
  if (near && !outcome.whole && kept_ == 0) {
    if (++tightened_ > kTightenings) return false;
    missed_ = aim_, missed_numbers_ = outcome.numbers;
    remember(outcome);
    aim_ *= kTighter;
    return true;
  }
  if (is_stalled(outcome)) return false;
  remember(outcome);
  const bool keeps = near && outcome.whole;
  (keeps ? kept_ : missed_) = aim_;
  (keeps ? kept_numbers_ : missed_numbers_) = outcome.numbers;
  if (kept_ == 0 || !std::isfinite(missed_)) {
    aim_ = corrected(outcome.rms);
    return true;
  }
  // No aim between the two saves more numbers.
  const double spared = static_cast<double>(kept_numbers_) / static_cast<double>(missed_numbers_);
  if (missed_ < kSameAim * kept_ || spared < kSameNumbers) return false;
  aim_ = std::sqrt(kept_ * missed_);
  return true;
}

namespace {

constexpr int kMostTries = 8;            // aims, for each overlap
constexpr double kWorthSearching = 1.5;  // tolerances: above, another aim comes first
// Where caps hardly agree, as between fingers, one band may produce a handle that another does not.
// If parts and handles differ from the shape's, both are tried (scripts/constants). A third band
// and a finer step corrected none of forty shapes that are wrong with these.
constexpr double kBands[] = {1, 2};  // times the band of the atlas
constexpr std::size_t kAnyHandles = std::numeric_limits<std::size_t>::max();

Atlas overlapping(Atlas atlas, const Overlap& overlap) {
  for (Cap& cap : atlas.caps) set_support(cap, overlap.reach * cap.frame.support);
  set_weights(atlas.caps, overlap.power);
  return atlas;
}

// Returns the atlas as it is read back from the file.
Atlas rounded(Atlas atlas, const Overlap& overlap) {
  set_weights(atlas.caps, overlap.power);
  return unpack(pack(atlas), "");
}

// The surface of a model, its measured errors, and its topology.
struct TrialSurface {
  AtlasModel model;
  Topology topology;
  std::size_t wrong = 0;  // parts and handles
};

// Ranks models, lower is better: first a kept tolerance, then the handles, then few numbers. If the
// tolerance is exceeded, right handles count first, then the error.
using Rank = std::tuple<bool, std::size_t, double>;
Rank rank(const AtlasModel& model, std::size_t wrong, double accepted) {
  const double rms = model.errors->rms();
  if (rms > accepted) return {true, wrong > 0, rms};
  return {false, wrong, static_cast<double>(size_of(model.atlas).numbers())};
}

// Returns nothing, without measuring, for a surface with `too_many` wrong handles or more.
std::optional<TrialSurface> try_surface(const FitTarget& target, AtlasModel model, double band,
                                        std::size_t too_many) {
  model.atlas.band *= band;
  const Mesh mesh = target.surface(model);
  TrialSurface trial{std::move(model), topology_of(inspect(mesh))};
  trial.wrong = n_wrong_handles(trial.topology, target.topology);
  if (trial.wrong >= too_many) return std::nullopt;
  trial.model.errors = target.measure(mesh);
  return trial;
}

// Returns the surface with the first band, or a better one with the second, and swaps the bands.
TrialSurface try_bands(const FitTarget& target, const AtlasModel& model,
                       std::array<double, 2>& bands) {
  TrialSurface first = *try_surface(target, model, bands[0], kAnyHandles);
  const bool worth = first.model.errors->rms() <= kWorthSearching * target.tolerance;
  if (first.wrong == 0 || !worth) return first;
  try {
    std::optional<TrialSurface> second = try_surface(target, model, bands[1], first.wrong);
    if (second && rank(second->model, second->wrong, target.accepted) <
                      rank(first.model, first.wrong, target.accepted)) {
      std::swap(bands[0], bands[1]);
      return std::move(*second);
    }
  } catch (const Error& error) {
    // A band that needs more than the allowed memory is not used.
    if (error.code() != ErrorCode::kOutOfMemory) throw;
  }
  return first;
}

}  // namespace

std::size_t n_wrong_handles(const Topology& found, const std::optional<Topology>& wanted) {
  if (!wanted) return 0;
  const auto between = [](std::size_t a, std::size_t b) { return std::max(a, b) - std::min(a, b); };
  return between(found.components, wanted->components) + between(found.genus, wanted->genus);
}

void fit_atlas(const FitTarget& target, const Atlas& chosen, const Overlap& overlap,
               Compressed& result, double& aim, const Context& context) {
  CompressReport& report = result.report;
  const Atlas covered = overlapping(chosen, overlap);
  const PruneOptions wanted{.tolerance = target.tolerance,
                            .band = covered.band,
                            .stray = target.stray,
                            .max_degree = target.max_degree};
  std::optional<Pruning> pruning;
  Aims aims(target.tolerance, aim > 0 ? aim : target.tolerance);
  std::array<double, 2> bands = {kBands[0], kBands[1]};
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
      trial = timed(report.times, "surface", [&] { return try_bands(target, model, bands); });
    } catch (const Error& error) {
      // There is no surface, or none within the allowed memory: the model found so far is kept.
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
      report.met = outcome.met, report.topology_kept = outcome.whole;
    }
    // If an error above the tolerance is accepted, another aim need not save numbers.
    const bool good = aims.is_close(outcome.rms) || target.tolerance < target.accepted;
    if (outcome.met && outcome.whole && good) break;
    if (outcome.met && !outcome.whole && !overlap.settles) {
      aim = std::min(aims.aim(), aims.corrected(outcome.rms));
      break;
    }
    // If the error exceeds the tolerance, the handles may be due to it, and another aim is tried.
    if (trial->wrong > kFewHandles && outcome.rms <= target.tolerance) break;
    if (!aims.advance(outcome)) break;
  }
}

}  // namespace rholm
