// Point clouds with difficulties that files have, and the contents of tiles in a store.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "base/random.h"
#include "io/shapes/test_support.h"
#include "reconstruct/points/point_source.h"
#include "reconstruct/points/point_survey.h"
#include "reconstruct/points/tile_plan.h"
#include "reconstruct/points/tile_points.h"
#include "rholm/mesh.h"

namespace rholm::testing {

// Points of a unit sphere, denser on one side, with unit normals and attributes; one attribute is
// the index. All values fit into single precision.
inline PointCloud sphere_points(std::size_t n, std::uint64_t seed = 1) {
  PointCloud cloud;
  cloud.attributes = {{"index", ScalarType::kUint32, {}}, {"shade", ScalarType::kUint8, {}}};
  // Rounds to 2^-20. GCC 12.2 at -O3 omits a conversion to float and back.
  const auto rounded = [](double x) { return std::round(x * 0x1p20) * 0x1p-20; };
  const auto single = [&](const Vec3& v) { return Vec3{rounded(v.x), rounded(v.y), rounded(v.z)}; };
  for (std::size_t i = 0; i < n; ++i) {
    const double u = random_uniform(seed, 2 * i),
                 phi = 6.283185307 * random_uniform(seed, 2 * i + 1);
    const double z = 2 * u * u - 1, r = std::sqrt(1 - z * z);
    const Vec3 normal{r * std::cos(phi), r * std::sin(phi), z};
    cloud.points.push_back(single(normal));
    cloud.normals.push_back(single(normal));
    cloud.attributes[0].values.push_back(static_cast<double>(i));
    cloud.attributes[1].values.push_back(static_cast<double>(i % 256));
  }
  return cloud;
}

// Returns the points with these indices, and all their values, in this order.
inline PointCloud chosen(const PointCloud& cloud, const std::vector<std::size_t>& indices) {
  PointCloud result;
  for (const Attribute& a : cloud.attributes) result.attributes.push_back({a.name, a.type, {}});
  for (const std::size_t i : indices) {
    result.points.push_back(cloud.points[i]);
    if (!cloud.normals.empty()) result.normals.push_back(cloud.normals[i]);
    for (std::size_t k = 0; k < cloud.attributes.size(); ++k) {
      result.attributes[k].values.push_back(cloud.attributes[k].values[i]);
    }
  }
  return result;
}

inline PointCloud shuffled(const PointCloud& cloud, std::uint64_t seed = 5) {
  std::vector<std::size_t> order(cloud.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size(); i > 1; --i) {
    std::swap(order[i - 1], order[random_bits(seed, i) % i]);
  }
  return chosen(cloud, order);
}

// A point with all its values.
using Row = std::vector<double>;
inline std::vector<Row> sorted_rows(const PointCloud& cloud) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    const Vec3& p = cloud.points[i];
    Row row = {p.x, p.y, p.z};
    if (!cloud.normals.empty()) {
      const Vec3& n = cloud.normals[i];
      row.insert(row.end(), {n.x, n.y, n.z});
    }
    for (const Attribute& a : cloud.attributes) row.push_back(a.values[i]);
    rows.push_back(std::move(row));
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

inline void append(const PointCloud& more, PointCloud& all) {
  if (all.points.empty()) {
    all = more;
    return;
  }
  all.points.insert(all.points.end(), more.points.begin(), more.points.end());
  all.normals.insert(all.normals.end(), more.normals.begin(), more.normals.end());
  for (std::size_t k = 0; k < all.attributes.size(); ++k) {
    auto& values = all.attributes[k].values;
    values.insert(values.end(), more.attributes[k].values.begin(), more.attributes[k].values.end());
  }
}

inline std::vector<std::vector<std::byte>> bytes_of_piece(const PieceStore& store,
                                                          const std::string& name) {
  const PieceReader piece = store.open(name);
  std::vector<std::vector<std::byte>> sections;
  sections.reserve(piece.n_sections());
  for (std::size_t k = 0; k < piece.n_sections(); ++k) sections.push_back(piece.read(k));
  return sections;
}

// Takes a source through all steps up to sorted tiles.
struct Tiles {
  Survey found;
  TilePlan plan;
  SortedTile counts;

  Tiles(PointSource& source, PieceStore& store, std::uint64_t points_per_tile,
        const SurveyOptions& options = {})
      : found(survey(source, options)), plan(make_plan(found, points_per_tile)) {
    distribute(source, found, plan, store, {.buffer_bytes = 10000});
    for (std::size_t k = 0; k < plan.n_tiles(); ++k) {
      const SortedTile one = sort_points(store, k);
      counts.points += one.points;
      counts.duplicates += one.duplicates;
      counts.opposite_normals += one.opposite_normals;
    }
  }
};

inline PointCloud all_points(const PieceStore& store, const TilePlan& plan) {
  PointCloud all;
  for (std::size_t k = 0; k < plan.n_tiles(); ++k) append(read_points(store, k), all);
  return all;
}

}  // namespace rholm::testing
