// Points spread over a surface in proportion to its area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/compensated_sum.h"
#include "rholm/mesh.h"

namespace rholm {

// Twice the area of triangles, one after the other; those without a direction count as 0, so that
// every sample has a normal.
class AreaSum {
 public:
  explicit AreaSum(double scale) : scale_(scale) {}  // of coordinates: areas of any unit in range
  // What the sum is with one more: never less than before.
  double add(const Mesh& mesh, const Triangle& t);

 private:
  double scale_;
  CompensatedSum sum_;
  double largest_ = 0;
};

// How samples are drawn: sample k lies on the first triangle up to which the area is more than
// target(k), and there at place().
struct AreaSampling {
  double share = 0;  // of twice the area
  std::uint64_t seed = 0;

  double target(std::size_t k) const;
  Vec3 place(std::size_t k, const Mesh& mesh, const Triangle& t) const;
};

// Throws InvalidInput for a surface of that area.
void check_area(double area, std::size_t n_triangles);

struct AreaSamples {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> triangles;  // on which each lies
};

// `n` points, one in each of n equal shares of the area laid out in the order of the triangles;
// sample k uses the random numbers 3k, 3k + 1, 3k + 2 of `seed`. Coordinates below about 1e70 in
// modulus. Throws InvalidInput for a mesh without area.
AreaSamples sample_by_area(const Mesh& mesh, std::size_t n, std::uint64_t seed);

// The same samples, any range of them by itself. Keeps a reference to the mesh; any thread may ask.
class AreaSampler {
 public:
  // Throws as sample_by_area().
  AreaSampler(const Mesh& mesh, std::size_t n, std::uint64_t seed);
  // Samples first ... first + count - 1.
  AreaSamples range(std::size_t first, std::size_t count) const;

 private:
  const Mesh& mesh_;
  std::size_t n_;
  std::uint64_t seed_;
  std::vector<double> sums_;  // of twice the areas, up to and with each triangle
};

}  // namespace rholm
