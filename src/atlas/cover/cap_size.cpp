#include "atlas/cover/cap_size.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "atlas/cap/cap_pole.h"
#include "atlas/cover/cap_seed.h"
#include "base/parallel.h"
#include "chart/cap/cap_frame.h"

namespace rholm {
namespace {

struct Trial {
  double slope_error = 1, rms = 0, level_rms = 0, slope_rms = 0, support = 0, own = 1;
};

// Number of seeds of a trial: the mean of their errors is then known to some
// hundredths. Noisy points need more, because their sizes differ by less.
constexpr std::size_t kSeeds = 400, kSeedsNoisy = 800;
// Range of tried numbers of points (method 7.11); the least gives 72 equations, 16 unknowns.
constexpr std::size_t kFewest = 24, kMost = 4000;
constexpr double kLadder = 1.5;
// Share of seeds that counts, with the least errors; others may be outliers, or on creases.
constexpr double kCounted = 0.8;
constexpr double kClearlyBetter = 0.8;
// Errors of a plane decrease with k without end. Caps do not grow beyond other sheets
// once slopes are off by less than this bound, and points by less than this part of the
// support. Residuals of trusted caps have the same bound (cap_cover.cpp). Bodies of
// half a spacing (scripts/scan-limits --thin) have up to twice the errors with 0.001,
// boxes of two fewer (0.1 instead of 0.8 %). With 0, blades have five times the errors.
constexpr double kExact = 0.002;
// Other sheets exist if less than this share of the nearby points is on the seed's
// own sheet. Chosen: without other sheets hardly any point has an opposite normal.
constexpr double kOneSheet = 0.9;
// Trials end when errors grow by this factor; for noisy points the factor is smaller.
constexpr double kGrown = 1.15, kGrownNoisy = 1.05;
// Errors of noisy points hardly change between sizes near the best, so
// the least error is random. Instead, the minimum of a parabola in log
// k is taken, through all errors within this factor of the least one.
constexpr double kNearBest = 1.1;
// Normals count this much more than their residuals suggest; creases enlarge these (method 7.11).
constexpr double kNormalsFavoured = 1.6;
// Factor for normals computed from the points, which carry no further information. On clean
// points (scripts/scan-figures) distances fall by 5 % to a half from 1.6 to 0.2, and are
// equal with 0.1. With noise these normals average many points: 0.2 is worse by a half.
constexpr double kComputedFavoured = 0.2;
// Median angle between clean normals and their caps above which normals count less, in proportion.
// At larger angles the normals turn within a cap by more than it can represent. Without the rule,
// 61 of 72 inputs with true normals (scripts/scan-figures --inputs 1k,3k --seeds 1,2,3) have the
// right parts and handles. With it 66 have them at 10 degrees, 67 at 8, 68 at 6; 4 is no better.
constexpr double kTurned = 6 * std::numbers::pi / 180;
// Residuals of the smallest caps above this part of their support are noise: no shape that caps
// can represent has as much. Below kNoticed they are negligible (a good fit in cap_cover.cpp).
constexpr double kSurelyNoise = 0.1;
constexpr double kNoticed = 0.02;
// In between, residuals are noise if they grow with the support by less than this power,
// between caps of k and of 9/4 k points. Noise grows with 0.2 ... 0.5, since small fits
// follow it, creases with 1, whole shapes with 1.4 ... 3 (scripts/constants).
constexpr double kShapeGrows = 0.85;
constexpr double kWide = 2.25;

// Slopes on the opened sphere are the surface's slopes over the dilation a, and over 1 + t^2 at t
// = s tan(kOpened / 2). Here s is the distance from the seed over the support. With the weights
// of take_points(), the mean square of (1 + t^2) over a disc is 1 + 2/3 0.257 + 1/9 0.107.
constexpr double kSlopesGrow = 1.088;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Trial try_seed(const OrderedPoints& all, std::size_t seed, std::size_t k,
               const CapFitOptions& options, CapWorker& worker) {
  Trial trial;
  worker.middle = all.points[seed];
  all.tree.nearest_to(seed, all.scaled(seed, k), worker.near);
  trial.support = std::sqrt(static_cast<double>(worker.near.back().distance2));
  if (!(trial.support > 0)) return trial;
  const Vec3 axis =
      take_points(all, seed, worker.near.size(), trial.support, CapSide::kSheet, true, worker);
  trial.own =
      static_cast<double>(worker.points.size() + 1) / static_cast<double>(worker.near.size());
  const CapFrame frame = cap_frame(worker.middle, axis, trial.support, kHalfAngle, kOpened);
  if (!fit_cap(frame, worker.points, options, worker.scratch, worker.fit)) return trial;
  trial.rms = worker.fit.rms;
  trial.level_rms = worker.fit.rms / frame.radius;
  trial.slope_rms = worker.fit.slope_rms;
  const Vec3& n = all.normals[seed];
  const double up = dot(n, frame.z);
  if (!(up > 0)) return trial;
  const CapPole pole = cap_pole(frame, options.basis, options.degree, worker.fit.coefficients);
  const double e1 = pole.slope1 + dot(n, frame.x) / up, e2 = pole.slope2 + dot(n, frame.y) / up;
  trial.slope_error = std::min(1.0, e1 * e1 + e2 * e2);
  return trial;
}

bool is_exact(const CapSizeTrial& trial) {
  return trial.neighbours > 0 && trial.slope_error < kExact * kExact &&
         trial.rms < kExact * trial.support;
}

// Returns the number of seeds of a trial: fewer for large caps, whose errors differ less.
std::size_t seeds_of(double k, bool noisy) {
  constexpr double kManyPoints = 500;
  constexpr std::size_t kFewestSeeds = 200;
  if (!noisy) return kSeeds;
  const auto n = static_cast<std::size_t>(kSeedsNoisy * std::min(1.0, kManyPoints / k));
  return std::max(n, kFewestSeeds);
}

// Returns true if the residuals of the smallest caps are noise, not shape.
bool is_noise(const OrderedPoints& points, const CapSizeTrial& first, int degree, double weight,
              const Context& context) {
  if (!(first.rms > kNoticed * first.support)) return false;
  if (first.rms > kSurelyNoise * first.support) return true;
  const auto more = static_cast<std::size_t>(kWide * static_cast<double>(first.neighbours));
  const CapSizeTrial wide = try_cap_size(points, more, degree, weight, kSeeds, context);
  return wide.rms < first.rms * std::pow(wide.support / first.support, kShapeGrows);
}

}  // namespace

double least_of_parabola(std::span<const double> x, std::span<const double> y) {
  // Fits y = c0 + c1 t + c2 t^2, t = x - mean(x), by normal equations of centred t and t^2.
  const auto n = static_cast<double>(x.size());
  double mean = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) mean += x[i] / n, mean_y += y[i] / n;
  double s2 = 0, s3 = 0, s4 = 0, sy = 0, s2y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double t = x[i] - mean, v = y[i] - mean_y;
    s2 += t * t, s3 += t * t * t, s4 += t * t * t * t, sy += t * v, s2y += t * t * v;
  }
  const double square = s4 - s2 * s2 / n, determinant = s2 * square - s3 * s3;
  if (!(determinant > 1e-9 * s2 * s4)) return std::numeric_limits<double>::quiet_NaN();
  const double c1 = (sy * square - s2y * s3) / determinant, c2 = (s2 * s2y - s3 * sy) / determinant;
  if (!(c2 > 0)) return std::numeric_limits<double>::quiet_NaN();
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  return std::clamp(mean - c1 / (2 * c2), *low, *high);
}

namespace {

// Returns the best number of points by all trials, or 0 if the trials do not determine one.
std::size_t steady_size(std::span<const CapSizeTrial> trials, double least) {
  std::vector<double> sizes, errors;
  for (const CapSizeTrial& trial : trials) {
    if (trial.slope_error > kNearBest * least) continue;
    sizes.push_back(std::log(static_cast<double>(trial.neighbours)));
    errors.push_back(trial.slope_error);
  }
  const double best = least_of_parabola(sizes, errors);
  return std::isfinite(best) ? static_cast<std::size_t>(std::exp(best)) : 0;
}

}  // namespace

CapSizeTrial try_cap_size(const OrderedPoints& points, std::size_t neighbours, int degree,
                          double gradient_weight, std::size_t n_seeds, const Context& context) {
  const std::size_t n = points.points.size();
  n_seeds = std::min(n_seeds, n);
  std::vector<Trial> trials(n_seeds);
  const CapFitOptions options{.degree = degree, .gradient_weight = gradient_weight};
  parallel_for(n_seeds, 16, context, {.name = "cap size"}, [&](std::size_t begin, std::size_t end) {
    CapWorker worker;
    for (std::size_t j = begin; j < end; ++j) {
      trials[j] = try_seed(points, j * n / n_seeds, neighbours, options, worker);
    }
  });
  CapSizeTrial mean{.neighbours = neighbours};
  std::vector<double> rms, level, slope, support;
  std::sort(trials.begin(), trials.end(),
            [](const Trial& a, const Trial& b) { return a.slope_error < b.slope_error; });
  const auto counted = static_cast<std::size_t>(kCounted * static_cast<double>(n_seeds)) + 1;
  for (std::size_t j = 0; j < std::min(counted, n_seeds); ++j) {
    mean.slope_error += trials[j].slope_error / static_cast<double>(counted);
  }
  mean.own = 0;
  for (const Trial& t : trials) {
    mean.own += t.own / static_cast<double>(n_seeds);
    rms.push_back(t.rms), level.push_back(t.level_rms);
    slope.push_back(t.slope_rms), support.push_back(t.support);
  }
  mean.rms = median(rms), mean.level_rms = median(level);
  mean.slope_rms = median(slope), mean.support = median(support);
  return mean;
}

CapSize choose_cap_size(const OrderedPoints& points, int degree, const Context& context) {
  CapSize best;
  CapSizeTrial chosen;
  std::vector<CapSizeTrial> trials;
  bool noisy = false;
  double weight = best.gradient_weight;
  const std::size_t stride = points.gaps != nullptr ? points.gaps->typical_stride() : 1;
  const std::size_t most = std::min(kMost, points.points.size() / (4 * stride));
  for (double k = kFewest; chosen.neighbours == 0 || k < static_cast<double>(most); k *= kLadder) {
    const CapSizeTrial trial = try_cap_size(points, static_cast<std::size_t>(k), degree, weight,
                                            seeds_of(k, noisy), context);
    trials.push_back(trial);
    if (trial.slope_rms > 0) weight = kNormalsFavoured * trial.level_rms / trial.slope_rms;
    if (k == kFewest) {
      noisy = is_noise(points, trial, degree, weight, context);
      // The error of fewer points says nothing: their slopes have part in the computed normals.
      if (const auto least = std::min(points.normal_neighbors, most);
          noisy && k * kLadder < static_cast<double>(least)) {
        k = static_cast<double>(least) / kLadder;
        trials.clear();
        continue;
      }
    }
    if (!noisy && is_exact(chosen) && trial.own < kOneSheet) break;
    // Clean points show no minimum: larger caps need a clear gain.
    const double better = noisy ? 1 : kClearlyBetter;
    if (chosen.neighbours == 0 || trial.slope_error < better * chosen.slope_error) chosen = trial;
    if (trial.slope_error > (noisy ? kGrownNoisy : kGrown) * chosen.slope_error) break;
  }
  if (const std::size_t k = noisy ? steady_size(trials, chosen.slope_error) : 0; k > 0) {
    chosen =
        try_cap_size(points, k, degree, weight, seeds_of(static_cast<double>(k), true), context);
  }
  best.neighbours = chosen.neighbours;
  best.normal_noise = chosen.slope_rms * dilation_between(kHalfAngle, kOpened) / kSlopesGrow;
  double favoured = kNormalsFavoured;
  if (!noisy) {
    favoured = points.normal_neighbors > 0
                   ? kComputedFavoured
                   : favoured * kTurned / std::max(kTurned, best.normal_noise);
  }
  if (chosen.slope_rms > 0) {
    best.gradient_weight = std::clamp(favoured * chosen.level_rms / chosen.slope_rms, 0.01, 10.0);
  }
  if (noisy) best.noise = chosen.rms;
  return best;
}

}  // namespace rholm
