// Measures the distance of an atlas's blend from samples of the
// surface, with the weights of the grid (method 7.5). Layer: atlas.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/cap/cap_limits.h"
#include "atlas/compress/cap_samples.h"
#include "rholm/atlas.h"
#include "rholm/context.h"

namespace rholm {

// Blend weights and distances of one cap at the samples it contributes to.
struct CapWeights {
  std::vector<std::uint32_t> samples;
  std::vector<float> weights, distances;
};

struct Blend {
  std::vector<CapWeights> caps;
  std::vector<double> weight, sum;  // sum of w and sum of w g per sample
  double rms = 0, max = 0;          // error of the blended distance, over samples with a weight
  std::size_t weightless = 0;       // number of samples without a weight
  double error(std::uint32_t sample) const { return sum[sample] / weight[sample]; }
  bool is_weightless(std::uint32_t sample) const { return !(weight[sample] > kLeastWeight); }
};

// Computes a cap's weights; samples beyond `band` from the
// cap have no weight. `points` are in the order of the tree.
CapWeights weights_of(const Cap& cap, std::span<const double> coefficients, const PointTree& tree,
                      std::span<const Vec3> points, double band);
Blend blend(const Atlas& atlas, const SampleLevel& samples, double band, const Context& context);

// Sets weights (largest support / support)^power, so that small caps override large ones.
void set_weights(std::span<Cap> caps, double power);

}  // namespace rholm
