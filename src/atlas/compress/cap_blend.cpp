#include "atlas/compress/cap_blend.h"

#include <algorithm>
#include <cmath>

#include "atlas/cap/cap_eval.h"
#include "atlas/cap/cap_support.h"
#include "base/parallel.h"

namespace rholm {
namespace {

// Returns a radius around the seed that contains all points with s < 1.
double reach(const Cap& cap) {
  const CapSupport& where = cap.where;
  return std::hypot(std::hypot(where.px, where.py) + longer_half_axis(where), cap.frame.support);
}

}  // namespace

CapWeights weights_of(const Cap& cap, std::span<const double> coefficients, const PointTree& tree,
                      std::span<const Vec3> points, double band) {
  CapWeights own;
  CapPoints within;
  std::vector<Neighbor> near;
  std::vector<double> rests;
  const Vec3 seed = cap.frame.seed();
  tree.within(seed, reach(cap), near);
  for (const Neighbor& n : near) {
    const Vec3 offset = points[n.index] - seed;
    const double rest = 1 - place(cap, offset);
    if (!(rest > 0)) continue;
    within.add(offset, cap.frame.z, 1);
    own.samples.push_back(n.index);
    rests.push_back(rest);
  }
  if (within.size() == 0) return own;
  within.pad();
  std::vector<double> distances(within.padded());
  cap_distances(cap, coefficients, within, distances);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < within.size(); ++i) {
    const double part = distances[i] / band, in_band = 1 - part * part;
    if (!(in_band > 0)) continue;  // also skips points without a potential
    own.samples[kept++] = own.samples[i];
    own.weights.push_back(
        static_cast<float>(cap.weight * rests[i] * rests[i] * rests[i] * in_band * in_band));
    own.distances.push_back(static_cast<float>(distances[i]));
  }
  own.samples.resize(kept);
  return own;
}

Blend blend(const Atlas& atlas, const SampleLevel& samples, double band, const Context& context) {
  Blend result;
  result.caps.resize(atlas.caps.size());
  parallel_for(atlas.caps.size(), 1, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Cap& cap = atlas.caps[c];
      result.caps[c] =
          weights_of(cap, atlas.coefficients_of(cap), samples.tree, samples.points, band);
    }
  });
  const std::size_t n = samples.points.size();
  result.weight.assign(n, 0);
  result.sum.assign(n, 0);
  for (const CapWeights& own : result.caps) {
    for (std::size_t i = 0; i < own.samples.size(); ++i) {
      const double w = own.weights[i];
      result.weight[own.samples[i]] += w;
      result.sum[own.samples[i]] += w * own.distances[i];
    }
  }
  double squares = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (result.is_weightless(i)) {
      ++result.weightless;
      continue;
    }
    const double e = std::abs(result.error(i));
    squares += e * e;
    result.max = std::max(result.max, e);
  }
  if (n > result.weightless)
    result.rms = std::sqrt(squares / static_cast<double>(n - result.weightless));
  return result;
}

void set_weights(std::span<Cap> caps, double power) {
  double largest = 0;
  for (const Cap& cap : caps) largest = std::max(largest, cap.frame.support);
  for (Cap& cap : caps) cap.weight = std::pow(largest / cap.frame.support, power);
}

}  // namespace rholm
