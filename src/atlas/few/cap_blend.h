// How far the blend of an atlas is from samples of the surface, as the grid has it (method 7.5).
// Layer: atlas.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/cap/cap_limits.h"
#include "atlas/few/cap_samples.h"
#include "rholm/atlas.h"
#include "rholm/context.h"

namespace rholm {

// What one cap says of the samples it reaches.
struct CapVoice {
  std::vector<std::uint32_t> samples;
  std::vector<float> weights, distances;
};

struct Blend {
  std::vector<CapVoice> caps;
  std::vector<double> weight, sum;  // per sample: sum of w, of w g
  double rms = 0, max = 0;          // of the blended distance, over samples that a cap speaks for
  std::size_t silent = 0;           // samples that none speaks for
  double error(std::uint32_t sample) const { return sum[sample] / weight[sample]; }
  bool is_silent(std::uint32_t sample) const { return !(weight[sample] > kLeastWeight); }
};

// Caps farther from a sample than `band` do not speak for it.
// `points` are in the order of the tree.
CapVoice voice_of(const Cap& cap, std::span<const double> coefficients, const PointTree& tree,
                  std::span<const Vec3> points, double band);
Blend blend(const Atlas& atlas, const SampleLevel& samples, double band, const Context& context);

// Weights that let small caps override large ones: (largest support / support)^power.
void set_weights(std::span<Cap> caps, double power);

}  // namespace rholm
