// A torus with a known surface, reconstructed in tiles.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <variant>
#include <vector>

#include "base/random.h"
#include "parts/threads.h"
#include "reconstruct/shared_tiles.h"
#include "rholm/points.h"
#include "rholm/primitives.h"
#include "rholm/reconstruct.h"
#include "rholm/shape_io.h"

namespace rholm::testing {

inline constexpr double kRing = 1.0, kTube = 0.4;

// Returns the exact distance to a torus about the z axis.
inline double distance_to_torus(const Vec3& x) {
  return std::hypot(std::hypot(x.x, x.y) - kRing, x.z) - kTube;
}

inline PointCloud torus_points(std::size_t n) {
  PointCloud cloud = sample_surface(torus(kRing, kTube, 300, 120), {.points = n, .seed = 7});
  for (std::size_t i = 0; i < n; ++i) {  // moves points onto the exact surface
    Vec3& p = cloud.points[i];
    const double around = std::hypot(p.x, p.y);
    const Vec3 middle{kRing * p.x / around, kRing * p.y / around, 0};
    cloud.normals[i] = normalized(p - middle);
    p = middle + kTube * cloud.normals[i];
  }
  return cloud;
}

// Returns the points for which keeps(place) is true, with their normals.
template <typename Keeps>
PointCloud those_of(const PointCloud& whole, const Keeps& keeps) {
  PointCloud some;
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    if (!keeps(whole.points[i])) continue;
    some.points.push_back(whole.points[i]);
    some.normals.push_back(whole.normals[i]);
  }
  return some;
}

// Returns the points outside a ball.
inline PointCloud with_hole(const PointCloud& whole, const Vec3& middle, double radius) {
  return those_of(whole, [&](const Vec3& p) { return !(norm(p - middle) < radius); });
}

// Adds points with random normals in the whole box around a torus: far from it and near it.
inline PointCloud with_outliers(PointCloud cloud, std::size_t n) {
  const auto random = [&](std::size_t i) { return 2 * random_uniform(11, i) - 1; };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = 6 * i;
    cloud.points.push_back({1.5 * random(k), 1.5 * random(k + 1), 0.6 * random(k + 2)});
    cloud.normals.push_back(normalized(Vec3{random(k + 3), random(k + 4), random(k + 5)}));
  }
  return cloud;
}

// A fixture with its own folder for files.
class TileFiles : public ::testing::Test {
 protected:
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }

  // Reconstructs in tiles, even if one suffices. `work` is the folder for data between the steps,
  // which is removed if it ends empty.
  ReconstructReport run(const PointCloud& cloud, std::uint64_t tile_points, const std::string& name,
                        const ReconstructOptions& options = {}, int threads = 2,
                        const std::string& work = "") const {
    ReconstructOptions wanted = options;
    wanted.tile_points = tile_points, wanted.output = path(name);
    if (!work.empty()) {
      wanted.work_dir = path(work), wanted.resume = true;
      std::filesystem::create_directory(path(work));
    }
    Threads alone;
    const Reconstruction made =
        reconstruct_tiles(cloud, 0, wanted, {.executor = alone}, {.threads = threads});
    if (!work.empty()) std::filesystem::remove(path(work));
    return made.report;
  }
  Mesh mesh(const std::string& name) const { return std::get<Mesh>(read_shape(path(name)).shape); }
  std::string bytes(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("rholm_tiles_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

 private:
  std::filesystem::path folder_;
};

inline double rms_of(const Mesh& mesh) {
  double sum = 0;
  for (const Vec3& v : mesh.vertices) sum += std::pow(distance_to_torus(v), 2);
  return std::sqrt(sum / static_cast<double>(mesh.vertices.size()));
}

// Returns the 99th percentile of the distances.
inline double most_of(const Mesh& mesh) {
  std::vector<double> distances;
  distances.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) distances.push_back(std::abs(distance_to_torus(v)));
  const auto at = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 99 / 100);
  std::nth_element(distances.begin(), at, distances.end());
  return *at;
}

}  // namespace rholm::testing
