// Counts how often directions from a centre meet a closed surface. Source: method 6.
//
// A half line meets k more front faces than back faces of a closed surface, the same k in all
// directions; k is 1 from inside a body. So it meets k faces plus two for each back face, and only
// back faces have to be looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "chart/center/local_view.h"
#include "rholm/context.h"

namespace rholm {

// Returns direction i of n evenly spread directions, which form a Fibonacci lattice.
Vec3 lattice_direction(std::size_t i, std::size_t n);

// Largest distance, in the unit frame, of a face's plane from a centre that may lie on the face.
inline constexpr double kNearPlane = 1e-9;

// Returns front faces minus back faces met by a direction; it is equal for all directions if the
// mesh is closed. Returns nothing if every tried direction meets an edge.
std::optional<int> surplus_of(const LocalView& view, const Vec3& center, const Context& context);

// Counts how often each of n directions meets the surface of a closed mesh. Returns nothing if the
// centre may lie on the surface, or if surplus_of() returns nothing. `low`: all faces with d_T <
// kNearPlane, in ascending order, possibly with other faces among them.
std::optional<std::vector<int>> count_meetings(const LocalView& view, const Vec3& center,
                                               std::size_t n, const std::vector<std::uint32_t>& low,
                                               const Context& context);

}  // namespace rholm
