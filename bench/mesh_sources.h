// Sources in the order of a mesh, for benchmarks: rows of points on the faces of a cube, each moved
// by a small random offset.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "harmonic/fft/fft.h"
#include "harmonic/nonuniform/nonuniform.h"

namespace rholm {

// Returns 6 n^2 unit vectors, face by face, row by row.
inline std::vector<Vec3> mesh_directions(std::size_t n) {
  std::vector<Vec3> directions;
  directions.reserve(6 * n * n);
  for (std::size_t j = 0; j < 6 * n * n; ++j) {
    const auto moved = [&](std::size_t i, std::uint64_t axis) {
      const double at = static_cast<double>(i) + 0.2 + 0.6 * random_uniform(axis, j);
      return std::tan((2 * at / static_cast<double>(n) - 1) * 0.78539816339744831);
    };
    const double a = moved(j % n, 1), b = moved(j / n % n, 2);
    const std::size_t face = j / (n * n);
    const double side = face % 2 == 0 ? 1 : -1;
    const Vec3 at = face / 2 == 0   ? Vec3{side, a, b}
                    : face / 2 == 1 ? Vec3{a, side, b}
                                    : Vec3{a, b, side};
    directions.push_back(at / norm(at));
  }
  return directions;
}

inline constexpr std::size_t kMedium = 150;  // 135 000 directions
inline constexpr std::size_t kLarge = 707;   // 3.0 million

inline const std::vector<Vec3>& directions_of(std::size_t n) {
  static const std::vector<Vec3> medium = mesh_directions(kMedium);
  if (n == kMedium) return medium;
  static const std::vector<Vec3> large = mesh_directions(kLarge);
  return large;
}

// Returns one sixteenth of the medium mesh, in runs of eight batches from all latitudes: as local
// as a mesh, and small enough to stay in the cache.
template <typename T>
std::vector<SourceBatch<T>> some_batches() {
  constexpr std::size_t kSize = SourceBatch<T>::kSize;
  const std::vector<Vec3>& directions = directions_of(kMedium);
  std::vector<SourceBatch<T>> batches(32);
  for (std::size_t b = 0; b < batches.size(); ++b) {
    SourceBatch<T>& batch = batches[b];
    const std::size_t first = (b / 8 * 128 + b % 8) * kSize;
    for (std::size_t j = 0; j < kSize; ++j) {
      const Vec3 u = directions[first + j];
      const double x[3] = {u.x, u.y, u.z};
      for (int i = 0; i < 3; ++i) batch.x[i][j] = x[i];
      batch.value[j] = T(0.5);
      for (int i = 0; i < 3; ++i) batch.gradient[i][j] = static_cast<T>(0.01 * x[i] + 0.01);
      for (int i = 0; i < 6; ++i) batch.hessian[i][j] = T(0.001);
    }
  }
  return batches;
}

inline constexpr int kDegree = 256;

template <typename T>
SphereFourier fourier_of(int width, int degree, double sigma) {
  const auto points = smooth_length(static_cast<std::size_t>(2 * sigma * degree), 4);
  return sphere_fourier(degree, grid_layout(width, points, points));
}

}  // namespace rholm
