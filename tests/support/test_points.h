// Point clouds for tests.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "rholm/mesh.h"
#include "shape/points/point_tree.h"
#include "support/random_data.h"

namespace rholm::test {

// Returns point(0), ..., point(n - 1).
inline std::vector<Vec3> points_of(std::size_t n, const std::function<Vec3(std::size_t)>& point) {
  std::vector<Vec3> points;
  points.reserve(n);
  for (std::size_t i = 0; i < n; ++i) points.push_back(point(i));
  return points;
}

inline double uniform(std::uint64_t seed, std::size_t i) { return random_in(-1, 1, seed, i); }

// Returns random points of the unit sphere with their normals.
inline PointCloud sphere_points(std::size_t n, std::uint64_t seed = 1) {
  PointCloud cloud;
  for (std::size_t i = 0; i < n; ++i) cloud.points.push_back(random_direction(seed, i));
  cloud.normals = cloud.points;
  return cloud;
}

// Returns a normally distributed number of standard deviation 1 (Box and Muller).
inline double random_normal(std::uint64_t seed, std::uint64_t counter) {
  const double u = 1 - random_in(0, 1, seed, 2 * counter);
  return std::sqrt(-2 * std::log(u)) *
         std::cos(random_in(0, 2 * std::numbers::pi, seed, 2 * counter + 1));
}

// Points and normals, sorted in the order of a tree over the points.
struct OrderedCloud {
  explicit OrderedCloud(const PointCloud& cloud) : tree(cloud.points) {
    for (const std::uint32_t i : tree.order()) {
      points.push_back(cloud.points[i]);
      if (!cloud.normals.empty()) normals.push_back(cloud.normals[i]);
    }
  }
  explicit OrderedCloud(const std::vector<Vec3>& given)
      : OrderedCloud(PointCloud{.points = given, .normals = {}, .attributes = {}}) {}

  // Returns flags of the sorted points in the order of the original cloud.
  std::vector<std::uint8_t> as_given(const std::vector<std::uint8_t>& flags) const {
    std::vector<std::uint8_t> result(flags.size());
    for (std::size_t i = 0; i < flags.size(); ++i) result[tree.order()[i]] = flags[i];
    return result;
  }

  PointTree tree;
  std::vector<Vec3> points, normals;
};

// Returns both clouds in one cloud, without attributes.
inline PointCloud joined(PointCloud a, const PointCloud& b) {
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  a.normals.insert(a.normals.end(), b.normals.begin(), b.normals.end());
  a.attributes.clear();
  return a;
}

// Returns a box of edge 2 with a bore from above: radius 0.4, depth 1.5, no points on its wall.
inline PointCloud bored_box(bool sensors) {
  PointCloud cloud;
  std::vector<double> at[3];
  const auto add = [&](const Vec3& point, const Vec3& normal) {
    cloud.points.push_back(point), cloud.normals.push_back(normal);
    at[0].push_back(10 * normal.x), at[1].push_back(10 * normal.y), at[2].push_back(10 * normal.z);
  };
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  std::uint64_t next = 0;
  const auto uniform = [&](double half) { return random_in(-half, half, 11, next++); };
  for (std::size_t k = 0; k < 3; ++k) {
    for (const double side : {-1.0, 1.0}) {
      for (int i = 0; i < 4000; ++i) {
        const double u = uniform(1), v = uniform(1);
        if (k == 2 && side == 1 && std::hypot(u, v) < 0.4) continue;
        add(u * axes[(k + 1) % 3] + v * axes[(k + 2) % 3] + side * axes[k], side * axes[k]);
      }
    }
  }
  for (int i = 0; i < 800; ++i) {
    const double u = uniform(0.4), v = uniform(0.4);
    if (std::hypot(u, v) < 0.4) add({u, v, -0.5}, axes[2]);
  }
  for (std::size_t k = 0; sensors && k < 3; ++k) {
    cloud.attributes.push_back({std::string("sensor_") + "xyz"[k], ScalarType::kFloat64, at[k]});
  }
  return cloud;
}

}  // namespace rholm::test
