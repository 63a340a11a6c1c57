#include "model/bricks/brick_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "model/bricks/brick_halo.h"
#include "model/bricks/brick_mending.h"
#include "model/bricks/brick_normals.h"
#include "model/bricks/brick_points.h"
#include "shape/points/outliers.h"

namespace rholm {
namespace {

// As of all points together (reconstruct_points.cpp).
constexpr double kTenthOfEven = 0.8;

// Of a value with a weight: the least one that at least this part of the weight does not exceed.
double quantile(const std::vector<std::pair<double, double>>& sorted, double part) {
  double whole = 0, sum = 0;
  for (const auto& [value, weight] : sorted) whole += weight;
  for (const auto& [value, weight] : sorted) {
    sum += weight;
    if (sum > part * whole) return value;
  }
  return sorted.empty() ? 0 : sorted.back().first;
}

// The normals that bricks have been given, without the points that have none; the confidence of
// those that stay.
std::vector<float> put_normals(const PieceStore& store, std::size_t brick, BrickAndHalo& read) {
  const auto found = gather<BrickNormal>(
      read, brick, [&](std::size_t other) { return read_normals(store, other); });
  PointCloud& cloud = read.cloud;
  cloud.normals.resize(cloud.points.size());
  std::vector<float> confidence;
  std::size_t kept = 0, own = 0;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3 normal = found.at(i).normal();
    if (normal == Vec3{}) continue;
    own += i < read.n_own ? 1 : 0;
    cloud.points[kept] = cloud.points[i];
    cloud.normals[kept] = normal;
    for (Attribute& attribute : cloud.attributes) attribute.values[kept] = attribute.values[i];
    confidence.push_back(found[i].confidence);
    ++kept;
  }
  if (kept == cloud.points.size()) return confidence;
  cloud.points.resize(kept), cloud.normals.resize(kept);
  for (Attribute& attribute : cloud.attributes) attribute.values.resize(kept);
  read.n_own = own;
  read.halo.clear();  // places are no longer those of the points
  return confidence;
}

void turn_normals(const PieceStore& store, std::size_t brick, BrickAndHalo& read) {
  const auto turned = gather<std::uint8_t>(
      read, brick, [&](std::size_t other) { return read_turned(store, other); });
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (turned[i] != 0) read.cloud.normals.at(i) = -read.cloud.normals[i];
  }
}

}  // namespace

BrickScene load_brick(const PieceStore& store, const BrickPlan& plan, std::size_t brick,
                      double halo, const Context& context) {
  BrickScene scene;
  BrickAndHalo read = read_with_halo(store, plan, brick, halo);
  std::vector<float> confidence;
  if (have_normals(store)) confidence = put_normals(store, brick, read);
  if (have_turned(store)) turn_normals(store, brick, read);
  scene.computed_normals = have_normals(store);
  scene.cloud = std::move(read.cloud);
  scene.n_own = read.n_own;
  scene.halo = std::move(read.halo);
  scene.tree = std::make_unique<PointTree>(scene.cloud.points, context);
  const std::size_t n = scene.tree->size();
  const bool directed = !scene.cloud.normals.empty();
  scene.points.resize(n);
  scene.foreign.resize(n);
  if (directed) scene.normals.resize(n);
  if (scene.computed_normals) scene.confidence.resize(n);
  parallel_for(n, 8192, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t given = scene.tree->order()[i];
      scene.points[i] = scene.cloud.points[given];
      scene.foreign[i] = given >= scene.n_own;
      if (directed) scene.normals[i] = normalized(scene.cloud.normals[given]);
      if (scene.computed_normals) scene.confidence[i] = confidence[given];
    }
  });
  if (n > 0) scene.gaps = find_gaps(*scene.tree, scene.points, scene.normals, context);
  return scene;
}

std::vector<SamplePoint> sample_brick(const BrickScene& scene, std::size_t n, std::size_t around,
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

std::vector<double> spacings_at(const BrickScene& scene, const std::vector<Vec3>& places) {
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

std::vector<double> spacings_of_sample(const Survey& survey, const BrickPlan& plan, double points) {
  const PointTree tree(survey.sample);
  const double finer = std::sqrt(std::min(1.0, static_cast<double>(tree.size()) / points));
  std::vector<std::vector<double>> of_bricks(plan.n_bricks());
  std::vector<Neighbor> near;
  for (std::size_t i = 0; i < tree.size(); ++i) {
    tree.nearest_to(i, kCircle + 1, near);
    of_bricks[plan.brick_of(survey.sample[tree.order()[i]])].push_back(
        finer * spacing_of_circle(near.back().distance2));
  }
  std::vector<double> result;
  for (std::vector<double>& own : of_bricks) {
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
