#include "atlas/compress/cap_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace rholm {
namespace {

constexpr std::size_t kFewestSamples = 1000;  // per level; fewer samples describe a surface badly
constexpr std::size_t kProbes = 500;          // points at which the spacing is measured

void find_neighbors(SampleLevel& level, const Context& context) {
  const std::size_t n = level.points.size();
  level.near.resize(kSampleNeighbors * n);
  parallel_for(n, 4096, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> found;
    for (std::size_t i = begin; i < end; ++i) {
      level.tree.nearest_to(i, kSampleNeighbors + 1, found);
      std::uint32_t* const near = &level.near[kSampleNeighbors * i];
      std::fill_n(near, kSampleNeighbors, static_cast<std::uint32_t>(i));
      for (std::size_t k = 1; k < found.size(); ++k) near[k - 1] = found[k].index;
    }
  });
}

// Computes the spacing s from discs of k neighbours: pi d^2 = k s^2.
double spacing_of(const SampleLevel& level) {
  std::vector<double> areas;
  std::vector<Neighbor> found;
  for (std::size_t j = 0; j < kProbes; ++j) {
    level.tree.nearest_to(j * level.points.size() / kProbes, kSampleNeighbors + 1, found);
    areas.push_back(std::numbers::pi * found.back().distance2 / kSampleNeighbors);
  }
  std::nth_element(areas.begin(), areas.begin() + kProbes / 2, areas.end());
  return std::sqrt(areas[kProbes / 2]);
}

std::unique_ptr<SampleLevel> make_level(std::span<const Vec3> points, std::span<const Vec3> normals,
                                        std::span<const std::uint32_t> base,
                                        const Context& context) {
  auto level =
      std::make_unique<SampleLevel>(SampleLevel{PointTree(points, context), {}, {}, {}, {}});
  for (const std::uint32_t i : level->tree.order()) {
    level->points.push_back(points[i]);
    level->normals.push_back(normals[i]);
    level->base.push_back(base[i]);
  }
  find_neighbors(*level, context);
  level->spacing = spacing_of(*level);
  return level;
}

}  // namespace

SampleLevels make_levels(std::span<const Vec3> points, std::span<const Vec3> normals,
                         const Context& context) {
  SampleLevels levels;
  std::vector<std::uint32_t> base(points.size());
  for (std::size_t i = 0; i < base.size(); ++i) base[i] = static_cast<std::uint32_t>(i);
  levels.levels.push_back(make_level(points, normals, base, context));
  // Indices of the finest level follow the order of its tree.
  std::vector<std::uint32_t> place(points.size());
  const auto order = levels.finest().tree.order();
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<std::uint32_t>(i);
  for (std::size_t i = 0; i < base.size(); ++i)
    levels.levels[0]->base[i] = static_cast<std::uint32_t>(i);
  for (std::size_t step = 4; points.size() / step >= kFewestSamples; step *= 4) {
    std::vector<Vec3> some, across;
    std::vector<std::uint32_t> from;
    for (std::size_t i = step / 2; i < points.size(); i += step) {
      some.push_back(points[i]);
      across.push_back(normals[i]);
      from.push_back(place[i]);
    }
    levels.levels.push_back(make_level(some, across, from, context));
  }
  return levels;
}

const SampleLevel& SampleLevels::level_for(double radius, std::size_t most) const {
  std::size_t i = 0;
  const auto count = [&](const SampleLevel& level) {
    return std::numbers::pi * radius * radius / (level.spacing * level.spacing);
  };
  while (i + 1 < levels.size() && count(*levels[i]) > static_cast<double>(most)) ++i;
  return *levels[i];
}

void PatchSearch::begin(std::size_t n) {
  if (seen_.size() < n) seen_.resize(n, 0);
  if (++mark_ != 0) return;
  std::fill(seen_.begin(), seen_.end(), 0);
  mark_ = 1;
}

}  // namespace rholm
