// Finds points that coincide. Layer: shape.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// Returns for every point the first point with bitwise equal coordinates, where 0 and -0 are equal.
// Points are finite and fewer than 2^32.
std::vector<std::uint32_t> first_identical(std::span<const Vec3> points,
                                           const Context& context = {.threads = 1});

}  // namespace rholm
