// Reproducible random inputs for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "base/random.h"
#include "rholm/coefficients.h"
#include "rholm/vec3.h"

namespace rholm::test {

inline double random_in(double low, double high, std::uint64_t seed, std::uint64_t counter) {
  return low + (high - low) * random_uniform(seed, counter);
}

// Returns a direction that is uniform on the unit sphere.
inline Vec3 random_direction(std::uint64_t seed, std::uint64_t counter) {
  const double z = random_in(-1, 1, seed, 2 * counter);
  const double phi = random_in(0, 2 * std::numbers::pi, seed, 2 * counter + 1);
  const double s = std::sqrt(1 - z * z);
  return normalized({s * std::cos(phi), s * std::sin(phi), z});
}

// Returns random directions. The poles and points very near to them come first.
inline std::vector<Vec3> random_directions(std::size_t n, std::uint64_t seed) {
  std::vector<Vec3> directions = {{0, 0, 1},
                                  {0, 0, -1},
                                  {1e-9, 0, 1},
                                  {1, 0, 0},
                                  {0, 1e-160, -1},
                                  {0, -1, 0},
                                  {-1e-4, 1e-4, std::sqrt(1 - 2e-8)}};
  while (directions.size() < n) directions.push_back(random_direction(seed, directions.size()));
  directions.resize(n);
  return directions;
}

template <typename T>
void shuffle(std::vector<T>& items, std::uint64_t seed) {
  for (std::size_t i = items.size(); i > 1; --i) {
    const auto k = static_cast<std::size_t>(random_in(0, 1, seed, i) * static_cast<double>(i));
    std::swap(items[i - 1], items[std::min(k, i - 1)]);
  }
}

inline std::vector<double> random_values(std::size_t n, std::uint64_t seed) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = random_in(-1, 1, seed, i);
  return values;
}

inline Coefficients random_coefficients(int degree, std::uint64_t seed) {
  Coefficients f(degree);
  std::uint64_t counter = 0;
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      f.c(l, m) = random_in(-1, 1, seed, counter++);
      if (m > 0) f.s(l, m) = random_in(-1, 1, seed, counter++);
    }
  }
  return f;
}

inline double inner(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

inline double norm_of(std::span<const double> a) { return std::sqrt(inner(a, a)); }

// Returns |a - b| / |b| over all coefficients; both have the same degree.
inline double relative_difference(const Coefficients& a, const Coefficients& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.values().size(); ++i) {
    square += std::pow(a.values()[i] - b.values()[i], 2);
  }
  return std::sqrt(square) / norm_of(b.values());
}

}  // namespace rholm::test
