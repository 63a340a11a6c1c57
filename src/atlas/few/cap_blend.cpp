#include "atlas/few/cap_blend.h"

#include <algorithm>
#include <cmath>

#include "atlas/cap/cap_eval.h"
#include "atlas/cap/cap_support.h"
#include "base/parallel.h"

namespace rholm {
namespace {

// Of all points with s < 1 about the seed.
double reach(const Cap& cap) {
  const CapSupport& where = cap.where;
  return std::hypot(std::hypot(where.px, where.py) + longer_half_axis(where), cap.frame.support);
}

}  // namespace

CapVoice voice_of(const Cap& cap, std::span<const double> coefficients, const PointTree& tree,
                  std::span<const Vec3> all, double band) {
  CapVoice voice;
  CapPoints points;
  std::vector<Neighbor> near;
  std::vector<double> rests;
  const Vec3 seed = cap.frame.seed();
  tree.within(seed, reach(cap), near);
  for (const Neighbor& n : near) {
    const Vec3 offset = all[n.index] - seed;
    const double rest = 1 - place(cap, offset);
    if (!(rest > 0)) continue;
    points.add(offset, cap.frame.z, 1);
    voice.samples.push_back(n.index);
    rests.push_back(rest);
  }
  if (points.size() == 0) return voice;
  points.pad();
  std::vector<double> distances(points.padded());
  cap_distances(cap, coefficients, points, distances);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double part = distances[i] / band, in_band = 1 - part * part;
    if (!(in_band > 0)) continue;  // also where the cap has no potential
    voice.samples[kept++] = voice.samples[i];
    voice.weights.push_back(
        static_cast<float>(cap.weight * rests[i] * rests[i] * rests[i] * in_band * in_band));
    voice.distances.push_back(static_cast<float>(distances[i]));
  }
  voice.samples.resize(kept);
  return voice;
}

Blend blend(const Atlas& atlas, const SampleLevel& samples, double band, const Context& context) {
  Blend result;
  result.caps.resize(atlas.caps.size());
  parallel_for(atlas.caps.size(), 1, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const Cap& cap = atlas.caps[c];
      result.caps[c] =
          voice_of(cap, atlas.coefficients_of(cap), samples.tree, samples.points, band);
    }
  });
  const std::size_t n = samples.points.size();
  result.weight.assign(n, 0);
  result.sum.assign(n, 0);
  for (const CapVoice& voice : result.caps) {
    for (std::size_t i = 0; i < voice.samples.size(); ++i) {
      const double w = voice.weights[i];
      result.weight[voice.samples[i]] += w;
      result.sum[voice.samples[i]] += w * voice.distances[i];
    }
  }
  double squares = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    if (result.is_silent(i)) {
      ++result.silent;
      continue;
    }
    const double e = std::abs(result.error(i));
    squares += e * e;
    result.max = std::max(result.max, e);
  }
  if (n > result.silent) result.rms = std::sqrt(squares / static_cast<double>(n - result.silent));
  return result;
}

void set_weights(std::span<Cap> caps, double power) {
  double largest = 0;
  for (const Cap& cap : caps) largest = std::max(largest, cap.frame.support);
  for (Cap& cap : caps) cap.weight = std::pow(largest / cap.frame.support, power);
}

}  // namespace rholm
