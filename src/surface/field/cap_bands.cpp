// Determines up to which distance from its surface each cap has a weight.
#include "surface/field/cap_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "atlas/cap/cap_pole.h"
#include "base/parallel.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {
namespace {

// Band of a small cap as a share of its support. On even points the grid's band is larger: 2.5
// steps of 0.6 spacings, at supports of 2.8 spacings. Chosen: three times the error that one cap in
// ten exceeds where density falls 300 times.
constexpr double kBandOfSupport = 0.35;
// Number of nearest caps searched. Caps lie half a support apart, other sheets included, so these
// caps cover one support.
constexpr std::size_t kBeside = 24;

bool is_small(const Cap& cap) { return cap.area > 0; }

// Returns the median distance, along the normal, to nearby caps on another
// sheet. The median is used because some of these caps may have a wrong normal.
double other_sheet(const std::vector<CapFoot>& feet, const PointTree& tree, std::size_t cap,
                   std::vector<Neighbor>& near) {
  std::vector<double> distances;
  tree.nearest(feet[cap].point, kBeside, near);
  for (const Neighbor& other : near) {
    const CapFoot& foot = feet[tree.order()[other.index]];
    if (dot(foot.normal, feet[cap].normal) >= kOtherSheet) continue;
    distances.push_back(std::abs(dot(foot.point - feet[cap].point, feet[cap].normal)));
  }
  if (distances.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

}  // namespace

double band_of_support(double support) { return kBandOfSupport * support; }

double band_of(const Atlas& atlas, double step) { return std::max(kBandSteps * step, atlas.band); }

CapBands::CapBands(const Atlas& atlas, double step, const Context& context)
    : least_(band_of(atlas, step)) {
  const auto wanted = [](const Cap& cap) {
    return is_small(cap) ? band_of_support(cap.frame.support) : 0;
  };
  if (std::none_of(atlas.caps.begin(), atlas.caps.end(),
                   [&](const Cap& cap) { return wanted(cap) > least_; })) {
    return;
  }
  std::vector<CapFoot> feet(atlas.caps.size());
  std::vector<Vec3> points(feet.size());
  parallel_for(feet.size(), 1024, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      feet[c] = cap_foot(atlas, atlas.caps[c]);
      points[c] = feet[c].point;
    }
  });
  const PointTree tree(points, context);
  own_.assign(feet.size(), least_);
  parallel_for(feet.size(), 256, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t c = begin; c < end; ++c) {
      const double most = wanted(atlas.caps[c]);
      if (most <= least_) continue;
      own_[c] = std::max(least_, std::min(most, other_sheet(feet, tree, c, near)));
    }
  });
}

}  // namespace rholm
