// What of the blend each cap answers for, and the points it is then fitted to (method 7.8).
// Layer: atlas.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/cap/cap_fit.h"
#include "atlas/compress/cap_blend.h"
#include "atlas/compress/cap_samples.h"
#include "rholm/atlas.h"
#include "rholm/context.h"

namespace rholm {

// Of an atlas at the samples its caps contribute to, in the order of Blend::caps.
struct CapShares {
  Blend blend;
  // |grad p|^2 along the surface, p = w / sum w the share of the cap: neighbours that disagree by d
  // leave a ledge of slope d |grad p|.
  std::vector<std::vector<float>> slopes;
};
CapShares shares_of(const Atlas& atlas, const SampleLevel& samples, double band,
                    const Context& context);

// The part of the samples where the surface leans by more than a slope because caps disagree:
// sum |grad p| |g - G| over the caps, G the blend of their potentials g; of two caps, the slope
// |grad p| |g_1 - g_2| of the ledge between them.
double share_of_ledges(const CapShares& shares, double slope);

// How a fit weighs samples.
struct ShareWeights {
  double tolerance = 0;  // samples that a cap misses by far more are left to others
  bool agree = false;    // whether caps are drawn to the blend where shares change
};

// The points that cap `index` with these coefficients is fitted to: the samples it contributes to,
// by its share of the blend and by the ledges it may leave, and its own surface with little weight,
// so that it stays where it is where it has no samples or leaves them to others. Padded.
void share_points(const Atlas& atlas, std::size_t index, std::span<const double> coefficients,
                  const SampleLevel& samples, const CapShares& shares, const ShareWeights& weights,
                  CapPoints& points);

// The fit to them: slopes weigh less than in a candidate's.
CapFitOptions share_fit(CapBasis basis, int degree);

struct AgreeOptions {
  double tolerance = 0;  // of ShareWeights
  double band = 0;       // of the blend
  bool all = false;      // coefficients that are zero too
};

// Fits the coefficients of all caps to samples that are moved to the blend as far as shares change
// there, all at once: one step towards caps that agree where they meet.
void agree(const SampleLevel& samples, const AgreeOptions& options, Atlas& atlas,
           const Context& context);

}  // namespace rholm
