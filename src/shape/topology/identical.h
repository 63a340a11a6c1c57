// Points that coincide. Layer: shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// For every point the first one with the same coordinates, bit by bit; 0 and -0 are the same. Fewer
// than 2^32 points, finite.
std::vector<std::uint32_t> first_identical(std::span<const Vec3> points,
                                           const Context& context = {.threads = 1});

}  // namespace rholm
