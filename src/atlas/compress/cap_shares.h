// Computes each cap's share of the blend, and the
// points for its next fit (method 7.8). Layer: atlas.
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

// Values of an atlas at the samples its caps contribute to, in the order of Blend::caps.
struct CapShares {
  Blend blend;
  // |grad p|^2 along the surface, where p = w / sum w is the cap's share.
  // Neighbours that differ by d leave a ledge of slope d |grad p|.
  std::vector<std::vector<float>> slopes;
};
CapShares shares_of(const Atlas& atlas, const SampleLevel& samples, double band,
                    const Context& context);

// Returns the share of samples where differences between caps tilt the surface by more than
// `slope`. The tilt is sum |grad p| |g - G| over the caps; G is the blend of their
// potentials g. For two caps it is the slope |grad p| |g_1 - g_2| of the ledge between them.
double share_of_ledges(const CapShares& shares, double slope);

// Determines how a fit weighs samples.
struct ShareWeights {
  double tolerance = 0;  // samples that a cap misses by far more are left to other caps
  bool agree = false;    // draws caps to the blend where shares change
};

// Computes the points, padded, to which cap `index` with these coefficients is fitted. Samples
// count by the cap's share of the blend, and by the ledges it may leave. The cap's own surface
// has little weight; it fixes the cap where samples are missing or left to others.
void share_points(const Atlas& atlas, std::size_t index, std::span<const double> coefficients,
                  const SampleLevel& samples, const CapShares& shares, const ShareWeights& weights,
                  CapPoints& points);

// Returns the options of this fit: slopes weigh less than in a candidate's fit.
CapFitOptions share_fit(CapBasis basis, int degree);

struct AgreeOptions {
  double tolerance = 0;  // tolerance of ShareWeights
  double band = 0;       // band of the blend
  bool all = false;      // true: also fits coefficients that are zero
};

// Fits the coefficients of all caps at once, to samples moved towards the blend
// where shares change. This is one step towards caps that agree where they meet.
void agree(const SampleLevel& samples, const AgreeOptions& options, Atlas& atlas,
           const Context& context);

}  // namespace rholm
