// Coefficients of an atlas that its error can do without (method 7.8). Layer: atlas.
#pragma once

#include <vector>

#include "atlas/compress/cap_samples.h"
#include "rholm/atlas.h"
#include "rholm/context.h"

namespace rholm {

struct PruneOptions {
  double tolerance = 0;  // rms of the blend, the samples' unit
  double band = 0;       // of the blend
  double stray = 0;      // supports shrink where a cap's surface is farther from all samples
  int more_degrees = 2;  // fitted before pruning, so that coefficients go where they serve most
  int max_degree = 14;
};

struct CapForm;    // the error of one cap as a function of its coefficients
struct CapShrink;  // how often a cap shrank

struct PruneReport {
  double rms = 0;                // of the blend
  std::size_t coefficients = 0;  // that are not zero
  double price = 0;  // squared error, summed over samples, that the last one dropped cost
};

// Fits the coefficients of all caps anew, by their shares in the blend; then, to one aim or
// several, sets to zero those that matter least until the blend's error is the aim, if the caps can
// meet it (see rms). What is left is fitted once more, so that caps agree where they meet. Caps
// lose the degrees that are all zero; supports shrink where caps stray. Refers to the samples.
class Pruning {
 public:
  // `options.tolerance` is the scale of what caps miss; aims are near it.
  Pruning(const SampleLevels& samples, const PruneOptions& options, const Atlas& atlas,
          const Context& context);
  ~Pruning();
  Pruning(const Pruning&) = delete;
  Pruning& operator=(const Pruning&) = delete;
  // Aims that come later begin with what was learnt from those before.
  PruneReport to(double aim, Atlas& pruned, const Context& context);

 private:
  const SampleLevels& samples_;
  PruneOptions options_;
  Atlas atlas_;
  std::vector<CapForm> forms_;
  std::vector<CapShrink> shrinks_;  // last
  std::vector<double> worth_;       // of caps' errors beside those of others
  // What caps may miss in all, squared, the blend's rms with it, and the power of it that that is.
  double budget_ = 0, reached_ = 0, power_ = 0.5;
};

// The number of coefficients that are not zero.
std::size_t n_kept(const Atlas& atlas);

}  // namespace rholm
