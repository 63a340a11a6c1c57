// Drops coefficients of an atlas with little effect on its error (method 7.8). Layer: atlas.
#pragma once

#include <vector>

#include "atlas/compress/cap_samples.h"
#include "rholm/atlas.h"
#include "rholm/context.h"

namespace rholm {

struct PruneOptions {
  double tolerance = 0;  // rms of the blend, in the samples' unit
  double band = 0;       // band of the blend
  double stray = 0;      // supports shrink where a cap's surface is farther from all samples
  int more_degrees = 2;  // fitted before pruning, so that the best coefficients are kept
  int max_degree = 14;
};

struct CapForm;    // the error of one cap as a function of its coefficients
struct CapShrink;  // how often a cap shrank

struct PruneReport {
  double rms = 0;                // rms error of the blend
  std::size_t coefficients = 0;  // number of nonzero coefficients
  double price = 0;  // squared error, summed over samples, of the last dropped coefficient
};

// Fits the coefficients of all caps again, by their shares in the blend. An aim is then met
// by zeroing the least important ones until the blend's error is the aim, if possible (see
// rms). The others are fitted again, so that caps agree where they meet. Degrees that are
// all zero are removed; supports shrink where caps leave the samples. Refers to the samples.
class Pruning {
 public:
  // `options.tolerance` is the scale of the caps' errors; aims are near it.
  Pruning(const SampleLevels& samples, const PruneOptions& options, const Atlas& atlas,
          const Context& context);
  ~Pruning();
  Pruning(const Pruning&) = delete;
  Pruning& operator=(const Pruning&) = delete;
  // Later aims start from the results of earlier ones.
  PruneReport to(double aim, Atlas& pruned, const Context& context);

 private:
  const SampleLevels& samples_;
  PruneOptions options_;
  Atlas atlas_;
  std::vector<CapForm> forms_;
  std::vector<CapShrink> shrinks_;  // last shrinks of each cap
  std::vector<double> worth_;       // weight of a cap's errors relative to other caps
  // Allowed sum of squared errors, the blend's rms with it, and the exponent between both.
  double budget_ = 0, reached_ = 0, power_ = 0.5;
};

// Returns the number of coefficients that are not zero.
std::size_t n_kept(const Atlas& atlas);

}  // namespace rholm
