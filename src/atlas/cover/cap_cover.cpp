#include "atlas/cover/cap_cover.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "atlas/cap/cap_fit.h"
#include "atlas/cap/cap_support.h"
#include "atlas/cover/cap_seed.h"
#include "base/large_vector.h"
#include "base/parallel.h"
#include "chart/cap/cap_frame.h"

namespace rholm {
namespace {

// Number of points per block. Seeds are chosen within blocks, so that
// blocks run in parallel. At their borders some caps are superfluous.
constexpr std::size_t kBlock = 4096;

// A fit is good if its residuals are below this part of the support
// (method 7.4), or of the noise. On sharp edges (scripts/constants),
// 0.01 and 0.02 leave more edges round or horned. Below 0.01 good
// points of rough shapes are classed as outliers.
constexpr double kGoodFit = 0.014;
constexpr double kGoodNoise = 1.12;  // see method 7.11
constexpr double kGoodShare = 0.85;
constexpr double kShrink = 0.65;
constexpr double kAlone = 0.7;
// Bound of the last resort with the fewest points; a worse fit is no surface.
constexpr double kAnyFit = 0.1;
constexpr double kAnyNoise = 2;
// The residuals of a cap are only a part of the error, and grow by about kGrow per size.
constexpr double kOfTolerance = 0.5;
constexpr double kGrow = 1.6;
constexpr std::size_t kMost = 4000;  // points of a cap of low degree
constexpr std::size_t kFewest = 8;   // points: 24 rows for 16 unknowns and a penalty
// A cap with too few points of its own sheet is searched for in this multiple of
// nearest points. With 2, more is wrong on blades of half a spacing and of one (1.1
// and 1.3 instead of 1.0 and 0.8 %). 4 is no better (scripts/scan-limits --thin).
constexpr std::size_t kFarther = 3;
// The third nearest of 24 random points in a disc is within a
// tenth of the farthest distance in two of a thousand cases.
constexpr std::size_t kInner = 3;
constexpr double kClose = 0.1;
// Residuals of this part of the support halve a cap's weight; a crease or a fold is left
// to caps without it. From 0.001 to 0.01 all values work equally well (scripts/constants).
constexpr double kTrusted = 0.002;
// The weight of a noisy cap is this power of its number of points. With 1 (their variance),
// small caps still make spikes at tips, where few others contribute. 2 and 3 are equally good.
constexpr double kTrustInPoints = 2;
// Least cosine between a point's normal and the cap's axis, to count as covered.
constexpr double kCovered = 0.7;

// Returns true if the points of a cap fill its disc. Points along a line, or in two distant groups,
// leave the space between open. Caps of needles, and of ridges thinner than the spacing, do not
// fill their discs.
bool fills_disc(const Cap& cap, std::size_t k, std::size_t inner, const CapWorker& worker) {
  const double inner2 = worker.near[std::min(inner, k - 1)].distance2;
  if (inner2 < kClose * kClose * worker.near[k - 1].distance2) return false;
  return fills_ellipse(cap.frame, moments_of(cap.frame, worker.points));
}

bool good(const CapFit& fit, double support, const CoverOptions& options) {
  return fit.usable >= kGoodShare &&
         fit.rms <= std::max(kGoodFit * support, kGoodNoise * options.noise);
}

bool is_trusted(const CapFit& fit, double support) {
  return fit.usable >= kGoodShare && fit.rms <= kTrusted * support;
}

// Fits a cap to the k nearest points; returns false if the fit fails.
bool fit_nearest(const OrderedPoints& all, std::size_t seed, std::size_t k, CapSide side,
                 const CoverOptions& options, CapWorker& worker, Cap& cap) {
  const double support = std::sqrt(static_cast<double>(worker.near[k - 1].distance2));
  if (!(support > 0)) return false;
  const Vec3 axis = take_points(all, seed, k, support, side, false, worker);
  cap.frame = cap_frame(worker.middle, axis, support, kHalfAngle, kOpened);
  const CapFitOptions wanted{.degree = options.degree, .gradient_weight = options.gradient_weight};
  return fit_cap(cap.frame, worker.points, wanted, worker.scratch, worker.fit);
}

// Grows the cap while it meets the tolerance. worker.fit
// and worker.points belong to the last good cap.
void grow_cap(const OrderedPoints& all, std::size_t seed, std::size_t k,
              const CoverOptions& options, CapWorker& worker, Cap& cap) {
  const double allowed = kOfTolerance * options.tolerance;
  for (std::size_t more = k; worker.fit.rms <= allowed && more < kMost;) {
    const std::size_t kept = more;
    more = static_cast<std::size_t>(kGrow * static_cast<double>(more));
    all.tree.nearest(worker.middle, more, worker.near);
    const std::size_t found = worker.near.size();
    const bool fitted =
        found > kept && fit_nearest(all, seed, found, CapSide::kSheet, options, worker, cap);
    if (fitted && worker.fit.rms <= allowed && worker.fit.usable >= kGoodShare) continue;
    worker.near.resize(std::min(found, kept));
    fit_nearest(all, seed, worker.near.size(), CapSide::kSheet, options, worker, cap);
    return;
  }
}

// If another sheet is among the k nearest points, fits a cap to k points of the
// seed's own sheet. The cap is kept only if it fits as well as a trusted cap.
void reach_farther(const OrderedPoints& all, std::size_t seed, std::size_t k,
                   const CoverOptions& options, CapWorker& worker, Cap& cap) {
  if (worker.points.size() >= k) return;
  all.tree.nearest_to(seed, kFarther * k, worker.near);
  const std::size_t reach = reach_of(all, seed, k, worker);
  if (reach > 0 && fit_nearest(all, seed, reach, CapSide::kSheet, options, worker, cap) &&
      is_trusted(worker.fit, cap.frame.support) &&
      fills_ellipse(cap.frame, moments_of(cap.frame, worker.points))) {
    worker.near.resize(reach);
  } else {
    worker.near.resize(std::min(k, worker.near.size()));
    fit_nearest(all, seed, worker.near.size(), CapSide::kSheet, options, worker, cap);
  }
}

// Enlarges a good cap of the seed's sheet, while the tolerance
// allows it, or if points of another sheet reduced its number.
void enlarge_cap(const OrderedPoints& all, std::size_t seed, std::size_t k, bool is_largest,
                 const CoverOptions& options, CapWorker& worker, Cap& cap) {
  if (options.tolerance > 0) {
    grow_cap(all, seed, k, options, worker, cap);
  } else if (is_largest && options.noise == 0) {
    reach_farther(all, seed, k, options, worker, cap);
  }
}

// Returns true if a point is isolated within a gap. Among 24 random points, 12 lie nearer
// than 0.7 of the farthest; fewer than two others do so once in ten thousand cases.
bool is_isolated(const std::vector<Neighbor>& near, std::size_t third) {
  return near.size() > third + 1 && near[third].distance2 > kAlone * kAlone * near.back().distance2;
}

// Finds the largest good cap around a point.
bool make_cap(const OrderedPoints& all, std::size_t seed, const CoverOptions& options,
              CapWorker& worker, Cap& cap) {
  worker.middle = all.points[seed];
  all.tree.nearest_to(seed, all.scaled(seed, options.neighbours), worker.near);
  if (is_isolated(worker.near, all.scaled(seed, 2))) return false;
  const std::size_t fewest = all.scaled(seed, kFewest), inner = all.scaled(seed, kInner);
  if (options.noise > 0) settle(all, seed, worker);
  const std::size_t wanted = worker.near.size();
  for (std::size_t k = wanted; k > 0;) {
    bool fitted = fit_nearest(all, seed, k, CapSide::kSheet, options, worker, cap);
    const auto fewer = static_cast<std::size_t>(kShrink * static_cast<double>(k));
    const double support = cap.frame.support;
    const bool full = fitted && fills_disc(cap, k, inner, worker);
    if (full && good(worker.fit, support, options)) {
      enlarge_cap(all, seed, k, k == wanted, options, worker, cap);
      return true;
    }
    // If there is a crease, one of its faces alone may fit; normals distinguish the faces.
    if (options.noise == 0) {
      fitted = fit_nearest(all, seed, k, CapSide::kFace, options, worker, cap);
      if (fitted && full && worker.points.size() >= fewest && good(worker.fit, support, options))
        return true;
    }
    if (fewer < fewest) {
      return fitted && worker.fit.rms <= std::max(kAnyFit * support, kAnyNoise * options.noise);
    }
    k = fewer;
  }
  return false;
}

// Sets the properties of a fitted cap.
void describe_cap(const CoverOptions& options, std::size_t wanted, const CapWorker& worker,
                  Cap& cap) {
  cap.degree = static_cast<std::uint16_t>(options.degree);
  cap.error = worker.fit.rms;
  cap.deviation = worker.fit.deviation;
  cap.where = ellipse_of(cap.frame, moments_of(cap.frame, worker.points));
  // Noise does not reduce the weight of a cap.
  const double noise = kGoodNoise * options.noise;
  const double excess = std::sqrt(std::max(0.0, worker.fit.rms * worker.fit.rms - noise * noise));
  const double part = excess / (kTrusted * cap.frame.support);
  cap.weight = 1 / (1 + part * part);
  if (options.noise == 0) return;
  const double share = static_cast<double>(worker.points.size()) / static_cast<double>(wanted);
  cap.weight *= std::pow(std::min(1.0, share), kTrustInPoints);
}

// Marks the points of a block in the cap's support; returns the number of new ones.
std::size_t mark(const OrderedPoints& all, const Cap& cap, std::size_t seed, std::size_t begin,
                 double core, const CapWorker& worker, std::vector<std::uint8_t>& covered) {
  std::size_t n_new = 1;
  covered[seed - begin] = 1;
  for (const Neighbor& near : worker.near) {
    if (near.index < begin || near.index - begin >= covered.size()) continue;
    std::uint8_t& flag = covered[near.index - begin];
    if (flag != 0 || dot(all.normals[near.index], cap.frame.z) < kCovered) continue;
    if (place(cap, all.points[near.index] - worker.middle) > core * core) continue;
    flag = 1;
    ++n_new;
  }
  return n_new;
}

void cover_block(const OrderedPoints& all, std::size_t begin, std::size_t end,
                 const CoverOptions& options, Cover& block) {
  CapWorker worker;
  std::vector<std::uint8_t> covered(end - begin, 0);
  if (!options.foreign.empty()) {
    std::copy(options.foreign.begin() + static_cast<std::ptrdiff_t>(begin),
              options.foreign.begin() + static_cast<std::ptrdiff_t>(end), covered.begin());
  }
  for (std::size_t seed = begin; seed < end; ++seed) {
    if (covered[seed - begin] != 0) continue;
    Cap cap;
    if (!make_cap(all, seed, options, worker, cap)) {
      block.rejected.push_back(static_cast<std::uint32_t>(seed));
      continue;
    }
    describe_cap(options, all.scaled(seed, options.neighbours), worker, cap);
    const std::size_t n_new = mark(all, cap, seed, begin, options.core, worker, covered);
    const double disc = std::numbers::pi * cap.frame.support * cap.frame.support;
    cap.area = disc * static_cast<double>(n_new) / static_cast<double>(worker.points.size());
    cap.first = block.coefficients.size();
    block.coefficients.insert(block.coefficients.end(), worker.fit.coefficients.begin(),
                              worker.fit.coefficients.end());
    block.caps.push_back(cap);
  }
}

}  // namespace

Cover cover(const OrderedPoints& points, const CoverOptions& options, const Context& context) {
  const std::size_t n = points.points.size(), n_blocks = (n + kBlock - 1) / kBlock;
  std::vector<Cover> made(n_blocks);
  parallel_for(n_blocks, 1, context, {.name = "caps"}, [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      cover_block(points, b * kBlock, std::min(n, (b + 1) * kBlock), options, made[b]);
    }
  });
  Cover result;
  std::size_t n_caps = 0, n_coefficients = 0;
  for (const Cover& block : made) {
    n_caps += block.caps.size(), n_coefficients += block.coefficients.size();
  }
  result.caps.reserve(n_caps), result.coefficients.reserve(n_coefficients);
  touch_pages(result.caps.data(), n_caps * sizeof(Cap), context);
  touch_pages(result.coefficients.data(), n_coefficients * sizeof(double), context);
  for (Cover& block : made) {
    for (Cap& cap : block.caps) {
      cap.first += result.coefficients.size();
      result.caps.push_back(cap);
    }
    const auto append = [](const auto& from, auto& to) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(block.coefficients, result.coefficients);
    append(block.rejected, result.rejected);
    block = {};
  }
  return result;
}

}  // namespace rholm
