#include <algorithm>
#include <array>
#include <cmath>

#include "atlas/cap/cap_support.h"
#include "atlas/compress/cap_blend.h"
#include "rholm/compress.h"
#include "shape/points/point_tree.h"

namespace rholm {
namespace {

// Distinguishable hues in the order of use: the hues of Okabe and Ito (2008) without black, and
// lighter variants of them.
constexpr std::array<std::array<std::uint8_t, 3>, 12> kHues = {{{230, 159, 0},
                                                                {86, 180, 233},
                                                                {0, 158, 115},
                                                                {213, 94, 0},
                                                                {0, 114, 178},
                                                                {204, 121, 167},
                                                                {240, 228, 66},
                                                                {148, 103, 189},
                                                                {140, 200, 120},
                                                                {160, 82, 45},
                                                                {120, 220, 210},
                                                                {250, 170, 160}}};
constexpr std::array<std::uint8_t, 3> kGrey = {128, 128, 128};

// Gives each cap the hue that is rarest among the earlier caps that overlap it, or the first of
// equally rare hues.
std::vector<std::size_t> hues_of(const Atlas& atlas) {
  std::vector<std::size_t> hues;
  for (const Cap& cap : atlas.caps) {
    std::array<double, kHues.size()> near = {};
    for (std::size_t other = 0; other < hues.size(); ++other) {
      const CapFrame& f = atlas.caps[other].frame;
      const double distance = norm(f.seed() - cap.frame.seed());
      const double reach = f.support + cap.frame.support;
      if (distance < reach) near[hues[other]] += 1 + 1e-3 * (1 - distance / reach);
    }
    hues.push_back(
        static_cast<std::size_t>(std::min_element(near.begin(), near.end()) - near.begin()));
  }
  return hues;
}

// Returns the cap whose support ends nearest to x, relative to its size.
std::uint32_t nearest_cap(const Atlas& atlas, const Vec3& x) {
  std::uint32_t nearest = kNoCap;
  double least = INFINITY;
  for (std::uint32_t c = 0; c < atlas.caps.size(); ++c) {
    const double s2 = place(atlas.caps[c], x - atlas.caps[c].frame.seed());
    if (!(s2 < least)) continue;
    least = s2;
    nearest = c;
  }
  return nearest;
}

}  // namespace

std::vector<std::uint32_t> dominant_caps(const Atlas& atlas, const std::vector<Vec3>& points,
                                         const Context& context) {
  std::vector<std::uint32_t> dominant(points.size(), kNoCap);
  if (points.empty()) return dominant;
  const PointTree tree(points, context);
  std::vector<Vec3> ordered;
  for (const std::uint32_t i : tree.order()) ordered.push_back(points[i]);
  std::vector<float> best(points.size(), 0);
  const double band = atlas.band > 0 ? atlas.band : INFINITY;
  for (std::uint32_t c = 0; c < atlas.caps.size(); ++c) {
    const Cap& cap = atlas.caps[c];
    const CapWeights own = weights_of(cap, atlas.coefficients_of(cap), tree, ordered, band);
    for (std::size_t i = 0; i < own.samples.size(); ++i) {
      const std::uint32_t at = tree.order()[own.samples[i]];
      if (own.weights[i] <= best[at]) continue;
      best[at] = own.weights[i];
      dominant[at] = c;
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (dominant[i] == kNoCap) dominant[i] = nearest_cap(atlas, points[i]);
  }
  return dominant;
}

namespace {

using Color = std::array<std::uint8_t, 3>;

// Sets the colours; `color_of` takes the index of a cap.
template <typename ColorOf>
void set_colors(std::vector<Attribute>& attributes, const std::vector<std::uint32_t>& caps,
                const ColorOf& color_of) {
  const std::array<const char*, 3> names = {"red", "green", "blue"};
  for (std::size_t channel = 0; channel < names.size(); ++channel) {
    Attribute color{names[channel], ScalarType::kUint8, {}};
    color.values.reserve(caps.size());
    for (const std::uint32_t cap : caps) {
      color.values.push_back((cap == kNoCap ? kGrey : color_of(cap))[channel]);
    }
    set_attribute(attributes, std::move(color));
  }
}

// Returns dark blue, green or yellow: lightness increases, so that grey prints are readable, too.
Color ramp(double t) {
  constexpr std::array<Color, 3> kStops = {{{52, 28, 110}, {33, 145, 140}, {253, 231, 37}}};
  const std::size_t i = t < 0.5 ? 0 : 1;
  const double part = 2 * t - static_cast<double>(i);
  Color color;
  for (std::size_t k = 0; k < color.size(); ++k) {
    color[k] =
        static_cast<std::uint8_t>(std::lround((1 - part) * kStops[i][k] + part * kStops[i + 1][k]));
  }
  return color;
}

}  // namespace

void set_cap_colors(std::vector<Attribute>& attributes, const Atlas& atlas,
                    const std::vector<std::uint32_t>& caps) {
  const std::vector<std::size_t> hues = hues_of(atlas);
  set_colors(attributes, caps, [&](std::uint32_t cap) { return kHues[hues[cap]]; });
}

void set_degree_colors(std::vector<Attribute>& attributes, const Atlas& atlas,
                       const std::vector<std::uint32_t>& caps) {
  if (atlas.caps.empty()) return set_cap_colors(attributes, atlas, caps);
  const auto [least, most] =
      std::minmax_element(atlas.caps.begin(), atlas.caps.end(),
                          [](const Cap& a, const Cap& b) { return a.degree < b.degree; });
  const double low = least->degree, range = std::max(1, most->degree - least->degree);
  set_colors(attributes, caps,
             [&](std::uint32_t cap) { return ramp((atlas.caps[cap].degree - low) / range); });
}

}  // namespace rholm
