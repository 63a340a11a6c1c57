#include "reconstruct/normals/tile_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "shape/points/outliers.h"

namespace rholm {
namespace {

// The first decile of spacings over their median, for even random points. It is less if a part of
// the points is denser.
constexpr double kTenthOfEven = 0.8;

// Returns the least value with at least this part of the total weight at or below it.
double quantile(const std::vector<std::pair<double, double>>& sorted, double part) {
  double whole = 0, sum = 0;
  for (const auto& [value, weight] : sorted) whole += weight;
  for (const auto& [value, weight] : sorted) {
    sum += weight;
    if (sum > part * whole) return value;
  }
  return sorted.empty() ? 0 : sorted.back().first;
}

}  // namespace

std::vector<SamplePoint> sample_tile(const TileScene& scene, std::size_t n, std::size_t around,
                                     const Context& context) {
  std::vector<std::uint32_t> own;
  for (std::uint32_t i = 0; i < scene.foreign.size(); ++i) {
    if (scene.foreign[i] == 0) own.push_back(i);
  }
  std::vector<SamplePoint> samples(std::min(n, own.size()));
  parallel_for(samples.size(), 64, context, {}, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbor> near;
    for (std::size_t j = begin; j < end; ++j) {
      SamplePoint& sample = samples[j];
      const std::size_t i = own[j * own.size() / samples.size()];
      const auto distance2_of = [&](std::size_t k) {
        scene.tree->nearest_to(i, k + 1, near);
        return near.back().distance2;
      };
      sample.spacing = spacing_of_circle(distance2_of(scene.gaps.scaled(i, kCircle)));
      const std::size_t k = std::min(scene.gaps.scaled(i, around), scene.points.size() - 1);
      sample.area = std::numbers::pi * distance2_of(k) / static_cast<double>(k);
      sample.place = i;
      sample.points = static_cast<double>(own.size()) / static_cast<double>(samples.size());
      sample.at = scene.points[i];
      scene.tree->nearest_to(i, kCircle + 1, near);
      sample.disc = near.back().distance2;
      if (scene.normals.empty()) continue;
      sample.normal = scene.normals[i];
      sample.wrong = has_wrong_normal(*scene.tree, scene.normals, i, near) ? 1 : 0;
    }
  });
  return samples;
}

std::vector<double> spacings_at(const TileScene& scene, const std::vector<Vec3>& places) {
  std::vector<double> spacings(places.size());
  std::vector<Neighbor> near;
  for (std::size_t i = 0; i < places.size(); ++i) {
    spacings[i] = spacing_around(*scene.tree, scene.gaps, places[i], near);
  }
  return spacings;
}

WholeSample join(const std::vector<SamplePoint>& samples) {
  std::vector<std::pair<double, double>> spacings;
  std::vector<double> discs;
  std::vector<Vec3> points, normals;
  WholeSample whole;
  double n = 0;
  for (const SamplePoint& sample : samples) {
    spacings.emplace_back(sample.spacing, sample.points);
    whole.area += sample.points * sample.area;
    whole.wrong += sample.points * sample.wrong;
    n += sample.points;
    discs.push_back(sample.points * sample.disc);
    points.push_back(sample.at), normals.push_back(sample.normal);
  }
  std::sort(spacings.begin(), spacings.end());
  whole.median = quantile(spacings, 0.5);
  whole.fine = std::min(whole.median, quantile(spacings, 0.1) / kTenthOfEven);
  whole.wrong = n > 0 ? whole.wrong / n : 0;
  whole.sides = balance_of(std::move(discs), points, normals);
  return whole;
}

std::vector<double> spacings_of_sample(const Survey& survey, const TilePlan& plan, double points) {
  const PointTree tree(survey.sample);
  const double finer = std::sqrt(std::min(1.0, static_cast<double>(tree.size()) / points));
  std::vector<std::vector<double>> of_tiles(plan.n_tiles());
  std::vector<Neighbor> near;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    tree.nearest_to(i, kCircle + 1, near);
    of_tiles[plan.tile_of(survey.sample[tree.order()[i]])].push_back(
        finer * spacing_of_circle(near.back().distance2));
  }
  std::vector<double> result;
  for (std::vector<double>& own : of_tiles) {
    std::sort(own.begin(), own.end());
    result.push_back(own.empty() ? 0 : own[own.size() * 9 / 10]);
  }
  return result;
}

double reach_of(std::size_t k) { return 2 * std::sqrt(static_cast<double>(k) / std::numbers::pi); }

CapSize median_of(const std::vector<CapSize>& sizes) {
  const auto median = [&](auto CapSize::*member) {
    std::vector<double> values;
    values.reserve(sizes.size());
    for (const CapSize& size : sizes) values.push_back(static_cast<double>(size.*member));
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  return {.neighbours = static_cast<std::size_t>(median(&CapSize::neighbours)),
          .noise = median(&CapSize::noise),
          .normal_noise = median(&CapSize::normal_noise),
          .gradient_weight = median(&CapSize::gradient_weight)};
}

}  // namespace rholm
