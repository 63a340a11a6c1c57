#include "atlas/compress/cap_shares.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atlas/cap/cap_eval.h"
#include "atlas/cap/cap_support.h"
#include "atlas/compress/cap_candidate.h"
#include "base/parallel.h"

namespace rholm {
namespace {

constexpr std::size_t kMostSamples = 6000;  // per fit; of more, every second, third ... is taken
// Least share in the blend with which a sample counts, where the cap is
// not overridden, so that the cap stays defined where others outweigh it.
constexpr double kLeastShare = 0.02;
// Least share where the cap misses the sample: there it may be wrong, but must stay near.
constexpr double kMissedShare = 0.003;
constexpr double kMissed = 4;  // in tolerances
// Weight of a cap's own surface where samples may be missing. Chosen: ten times more costs
// 1 % of the coefficients; with ten times less, a third of the caps leave the samples.
constexpr double kOwnShare = 0.03;
constexpr double kGradientWeight = 0.1;

// Tolerances that equal a ledge of slope 1. Chosen by scripts/atlas-figures: a ledge
// of 5 degrees then counts as one tolerance. A value of 20 takes 3 % more numbers.
// It leaves a fifth fewer wrong normals on a bunny, and no fewer on the Armadillo.
constexpr double kLedge = 12;
// Largest weight of a ledge, in shares: slopes are unbounded where a support ends between samples.
constexpr double kMostLedge = 10;

// Returns grad w along the surface; only the factor (1 - s^2)^3 of the position is used.
Vec3 weight_slope(const Cap& cap, double weight, const Vec3& at, const Vec3& normal) {
  const Vec3 offset = at - cap.frame.seed();
  const double rest = 1 - place(cap, offset);
  if (!(rest > 0)) return {};
  const Vec3 slope = (-3 * weight / rest) * support_gradient(cap, offset);
  return slope - dot(slope, normal) * normal;
}

// Adds points of a sunflower pattern, carried along the rays to the cap's surface.
void add_own_surface(const Cap& cap, std::span<const double> coefficients, double spacing,
                     CapPoints& points) {
  const CapFrame& f = cap.frame;
  const double samples = std::numbers::pi * f.support * f.support / (spacing * spacing);
  const auto n = static_cast<std::size_t>(std::clamp(samples / 4, 100.0, 2000.0));
  CapPoints plane;
  add_sunflower(f, n, plane);
  plane.pad();
  const std::size_t stride = plane.padded();
  std::vector<double> at(3 * stride), across(3 * stride);
  cap_surface(cap, coefficients, plane, at, across);
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3 offset{at[k], at[stride + k], at[2 * stride + k]};
    const Vec3 normal{across[k], across[stride + k], across[2 * stride + k]};
    const Vec3 ray = offset + f.radius * f.z;
    const double cosine = dot(normal, ray) / norm(ray);
    if (!(cosine > 0.1)) continue;  // also skips rays without a surface
    points.add(offset, normal, kOwnShare * cosine * cosine * samples / static_cast<double>(n));
  }
}

// Solves the equations of some coefficients alone; returns false if they are singular.
bool solve_some(const CapSystem& system, const std::vector<std::size_t>& some,
                CapFitScratch& scratch, std::vector<double>& solution) {
  std::vector<std::size_t> rows = {0};  // row 0 is the right-hand side
  for (const std::size_t i : some) rows.push_back(1 + i);
  const std::size_t n = some.size(), stride = n + 1;
  std::vector<double> block(stride * stride);
  for (std::size_t i = 0; i < stride; ++i) {
    for (std::size_t j = i; j < stride; ++j) {
      block[i * stride + j] = scratch.matrix[rows[i] * (system.n + 1) + rows[j]];
    }
  }
  if (scratch.factor.factor(block.data(), n, kFewPivot) < n) return false;
  scratch.factor.solve(n, solution);
  return true;
}

// Fits one cap again: its nonzero coefficients, or all.
void refit(const Cap& cap, const CapPoints& points, bool all, std::span<double> coefficients) {
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    if (all || coefficients[i] != 0) kept.push_back(i);
  }
  if (kept.empty() || points.size() == 0) return;
  CapFitScratch scratch;
  const CapSystem system =
      make_system(cap.frame, points, share_fit(cap.basis, cap.degree), scratch);
  std::vector<double> solution;
  if (!system.solvable || !solve_some(system, kept, scratch, solution)) return;
  for (std::size_t i = 0; i < kept.size(); ++i) coefficients[kept[i]] = solution[i];
}

}  // namespace

CapShares shares_of(const Atlas& atlas, const SampleLevel& samples, double band,
                    const Context& context) {
  CapShares shares{blend(atlas, samples, band, context), {}};
  const Blend& all = shares.blend;
  const std::size_t n = atlas.caps.size();
  const auto each = [&](const auto& visit) {
    parallel_for(n, 1, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) visit(c);
    });
  };
  std::vector<std::vector<Vec3>> of_caps(n);
  each([&](std::size_t c) {
    const CapWeights& own = all.caps[c];
    of_caps[c].resize(own.samples.size());
    for (std::size_t i = 0; i < own.samples.size(); ++i) {
      const std::uint32_t s = own.samples[i];
      of_caps[c][i] =
          weight_slope(atlas.caps[c], own.weights[i], samples.points[s], samples.normals[s]);
    }
  });
  std::vector<Vec3> sums(samples.points.size());
  for (std::size_t c = 0; c < n; ++c) {
    for (std::size_t i = 0; i < of_caps[c].size(); ++i)
      sums[all.caps[c].samples[i]] += of_caps[c][i];
  }
  shares.slopes.resize(n);
  each([&](std::size_t c) {
    const CapWeights& own = all.caps[c];
    shares.slopes[c].resize(own.samples.size());
    for (std::size_t i = 0; i < own.samples.size(); ++i) {
      const std::uint32_t s = own.samples[i];
      if (all.is_weightless(s)) continue;
      const double sum = all.weight[s];
      const Vec3 slope = (of_caps[c][i] - (own.weights[i] / sum) * sums[s]) / sum;
      shares.slopes[c][i] = static_cast<float>(dot(slope, slope));
    }
  });
  return shares;
}

double share_of_ledges(const CapShares& shares, double slope) {
  const Blend& all = shares.blend;
  std::vector<double> leans(all.weight.size());
  for (std::size_t c = 0; c < all.caps.size(); ++c) {
    const CapWeights& own = all.caps[c];
    for (std::size_t i = 0; i < own.samples.size(); ++i) {
      const std::uint32_t s = own.samples[i];
      if (all.is_weightless(s)) continue;
      const double part = std::sqrt(double{shares.slopes[c][i]});
      leans[s] += part * std::abs(own.distances[i] - all.error(s));
    }
  }
  const auto n = std::count_if(leans.begin(), leans.end(), [&](double l) { return l > slope; });
  const std::size_t weighted = leans.size() - all.weightless;
  return weighted > 0 ? static_cast<double>(n) / static_cast<double>(weighted) : 0;
}

void share_points(const Atlas& atlas, std::size_t index, std::span<const double> coefficients,
                  const SampleLevel& samples, const CapShares& shares, const ShareWeights& weights,
                  CapPoints& points) {
  const Cap& cap = atlas.caps[index];
  const CapFrame& f = cap.frame;
  const CapWeights& own = shares.blend.caps[index];
  const double ledge = kLedge * weights.tolerance, ledge2 = ledge * ledge;
  const std::size_t step = (own.samples.size() + kMostSamples - 1) / kMostSamples;
  points.clear();
  for (std::size_t i = 0; i < own.samples.size(); i += step) {
    const std::uint32_t s = own.samples[i];
    if (shares.blend.is_weightless(s)) continue;
    const bool missed = std::abs(own.distances[i]) >= kMissed * weights.tolerance;
    const double share =
        std::max(own.weights[i] / shares.blend.weight[s], missed ? kMissedShare : kLeastShare);
    const double meets = std::min(kMostLedge, ledge2 * shares.slopes[index][i]);
    // The mean that minimises share e^2 + meets (e - G)^2.
    const double moved = weights.agree ? meets / (share + meets) * shares.blend.error(s) : 0;
    const Vec3 at = samples.points[s] - moved * samples.normals[s];
    const Vec3 ray = at - f.center;
    const double cosine = dot(samples.normals[s], ray) / norm(ray);
    if (cosine < 0.1) continue;
    points.add(at - f.seed(), samples.normals[s],
               (share + meets) * cosine * cosine * static_cast<double>(step));
  }
  add_own_surface(cap, coefficients, samples.spacing, points);
  points.pad();
}

CapFitOptions share_fit(CapBasis basis, int degree) {
  return {basis, degree, kGradientWeight, kFewPenalty};
}

void agree(const SampleLevel& samples, const AgreeOptions& options, Atlas& atlas,
           const Context& context) {
  const CapShares shares = shares_of(atlas, samples, options.band, context);
  parallel_for(atlas.caps.size(), 1, context, {}, [&](std::size_t begin, std::size_t end) {
    CapPoints points;
    for (std::size_t c = begin; c < end; ++c) {
      const Cap& cap = atlas.caps[c];
      const std::span<double> own(atlas.coefficients.data() + cap.first,
                                  n_coefficients(cap.basis, cap.degree));
      share_points(atlas, c, own, samples, shares, {.tolerance = options.tolerance, .agree = true},
                   points);
      refit(cap, points, options.all, own);
    }
  });
}

}  // namespace rholm
