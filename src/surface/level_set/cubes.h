// Cubes of space with hash keys.
#pragma once

#include <array>
#include <cstdint>

#include "rholm/vec3.h"

namespace rholm {

using Cube = std::array<std::int64_t, 3>;

inline Cube cube_of(const Vec3& x, double edge) {
  // std::floor may be a function call, depending on the processor; this code is not.
  const auto floor_of = [](double c) {
    const auto whole = static_cast<std::int64_t>(c);
    return whole - (static_cast<double>(whole) > c ? 1 : 0);
  };
  return {floor_of(x.x / edge), floor_of(x.y / edge), floor_of(x.z / edge)};
}

// Two cubes with equal keys only enlarge the searched region.
inline std::uint64_t key_of(const Cube& cube) {
  std::uint64_t bits = 0;
  for (const std::int64_t c : cube) {
    bits = bits * 0x9E3779B97F4A7C15u + static_cast<std::uint64_t>(c);
  }
  return bits;
}

// Calls visit(key) for the cube and the 26 cubes around it.
template <typename Visit>
void for_each_near(const Cube& cube, Visit visit) {
  for (const int z : {-1, 0, 1}) {
    for (const int y : {-1, 0, 1}) {
      for (const int x : {-1, 0, 1}) visit(key_of({cube[0] + x, cube[1] + y, cube[2] + z}));
    }
  }
}

}  // namespace rholm
