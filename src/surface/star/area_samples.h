// Points spread over a surface in proportion to its area.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh.h"

namespace rholm {

struct AreaSamples {
  std::vector<Vec3> points;
  std::vector<std::uint32_t> triangles;  // on which each lies
};

// `n` points, one in each of n equal shares of the area laid out in the order of the triangles;
// sample k uses the random numbers 3k, 3k + 1, 3k + 2 of `seed`. Coordinates below about 1e70 in
// modulus. Throws InvalidInput for a mesh without area.
AreaSamples sample_by_area(const Mesh& mesh, std::size_t n, std::uint64_t seed);

}  // namespace rholm
