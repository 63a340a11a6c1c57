#include "shape/points/local_shape.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/parallel.h"
#include "rholm/topology.h"
#include "shape/points/plane_fit.h"

namespace rholm {
namespace {

// Limits of the flattest neighbourhoods' median thickness. Measured by tests/cli/clouds_test.py
// --thresholds on surfaces with noise of up to 2.5 % of the diagonal, and on points of no surface.
// The noisiest ball has 0.3, a filled slab five times as wide as thick 0.5, a filled ball 0.68.
constexpr double kFlat = 0.4;    // below: surely a surface
constexpr double kThick = 0.63;  // above: surely no surface
constexpr double kFilled = 2.4;  // between the two limits: a volume if the kurtosis is below this
// Median width of neighbourhoods: a curve has less than kLong at one scale at least. Below kWide
// they count as no surface. Random points of a surface have 0.7 and more.
constexpr double kLong = 0.25, kWide = 0.4;
constexpr std::size_t kSeeds = 200, kFewest = 100;
constexpr std::size_t kFirst = 12, kMost = 16384;
// Largest radius of a local neighbourhood, relative to the diagonal.
constexpr double kLocal = 0.2;
constexpr double kSameSide = 0;       // least cosine of two normals on one sheet
constexpr double kCrooked = 0.70711;  // least cosine between plane normal and given normal

struct Seed {
  double radius = 0, thickness = 1, width = 0, kurtosis = 3;
  bool crooked = false;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Seed look(const PointTree& tree, std::span<const Vec3> points, std::span<const Vec3> normals,
          std::size_t i, std::size_t k) {
  std::vector<Neighbor> near;
  tree.nearest_to(i, k + 1, near);
  std::vector<Vec3> around;
  for (const Neighbor& other : near) {
    const bool counts = normals.empty() || dot(normals[other.index], normals[i]) >= kSameSide;
    if (counts) around.push_back(points[other.index] - points[i]);
  }
  Seed seed{.radius = std::sqrt(static_cast<double>(near.back().distance2))};
  if (!(seed.radius > 0) || around.size() < 4) return seed;
  for (Vec3& p : around) p = p / seed.radius;
  const std::vector<double> weights(around.size(), 1.0);
  const PlaneFit plane = fit_plane(around, weights);
  if (!(plane.length > 0)) return seed;
  // plane.width is the sum of the products of two eigenvalues each, over the largest eigenvalue.
  const double second = (plane.width - plane.height) / (1 + plane.height / plane.length);
  seed.width = std::sqrt(std::max(0.0, second) / plane.length);
  seed.thickness = second > 0 ? std::sqrt(plane.height / second) : 1;
  if (!normals.empty()) seed.crooked = std::abs(dot(plane.normal, normals[i])) < kCrooked;
  Vec3 middle;
  for (const Vec3& p : around) middle += p / static_cast<double>(around.size());
  double squares = 0, fourth = 0;
  for (const Vec3& p : around) {
    const double h = dot(p - middle, plane.normal);
    squares += h * h, fourth += h * h * h * h;
  }
  if (squares > 0)
    seed.kurtosis = fourth * static_cast<double>(around.size()) / (squares * squares);
  return seed;
}

// Looks at k neighbours of seeds that are spread evenly over the order of the tree.
std::vector<Seed> look_around(const PointTree& tree, std::span<const Vec3> points,
                              std::span<const Vec3> normals, std::size_t k,
                              const Context& context) {
  const std::size_t n = points.size();
  std::vector<Seed> seeds(std::min(n, kSeeds));
  parallel_for(seeds.size(), 8, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      seeds[s] = look(tree, points, normals, s * n / seeds.size(), k);
    }
  });
  return seeds;
}

double median_of(const std::vector<Seed>& seeds, double Seed::*member) {
  std::vector<double> values;
  values.reserve(seeds.size());
  for (const Seed& seed : seeds) values.push_back(seed.*member);
  return median(std::move(values));
}

}  // namespace

double kurtosis_of_heights(const PointTree& tree, std::span<const Vec3> points, std::size_t k,
                           const Context& context) {
  return median_of(look_around(tree, points, {}, k, context), &Seed::kurtosis);
}

LocalShape look_at_shape(const PointTree& tree, std::span<const Vec3> points,
                         std::span<const Vec3> normals, const Context& context) {
  LocalShape shape{.thickness = 1};
  const std::size_t n = points.size();
  if (n < kFewest) return shape;
  std::vector<Seed> seeds(std::min(n, kSeeds));
  std::vector<Vec3> places;
  places.reserve(seeds.size());
  for (std::size_t s = 0; s < seeds.size(); ++s) places.push_back(points[s * n / seeds.size()]);
  const double local = kLocal * bounds(places).diagonal();
  bool was_long = false;
  for (std::size_t k = kFirst; k <= std::min(n / 4, kMost); k += k / 2) {
    seeds = look_around(tree, points, normals, k, context);
    const auto middle = [&](double Seed::*member) { return median_of(seeds, member); };
    if (k > kFirst && middle(&Seed::radius) > local) break;
    const double thickness = middle(&Seed::thickness), width = middle(&Seed::width);
    was_long |= width < kLong;
    if (width < kWide || thickness >= shape.thickness) continue;
    shape.neighbors = k, shape.thickness = thickness, shape.width = width;
    shape.kurtosis = middle(&Seed::kurtosis);
    double flat = 0, crooked = 0;
    for (const Seed& seed : seeds) {
      if (!(seed.thickness < kFlat)) continue;
      flat += 1;
      crooked += seed.crooked ? 1 : 0;
    }
    shape.crooked = flat > 0 ? crooked / flat : 0;
    if (thickness < kFlat) break;
  }
  const bool flat =
      shape.thickness < kFlat || (shape.thickness < kThick && shape.kurtosis > kFilled);
  shape.kind = flat ? LocalKind::kSurface : was_long ? LocalKind::kCurve : LocalKind::kVolume;
  return shape;
}

}  // namespace rholm
