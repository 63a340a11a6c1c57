// How often directions from a centre meet a closed surface. Source: method 6.
//
// What a half line meets of a closed surface with its front and with its back differs by the same
// number in all directions, k: 1 from inside a body. So it meets the surface k times and twice for
// each face that turns its back, and only these have to be looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "chart/center/local_view.h"
#include "rholm/context.h"

namespace rholm {

// Direction i of n, spread evenly: a Fibonacci lattice.
Vec3 lattice_direction(std::size_t i, std::size_t n);

// Faces whose planes are this near to the centre, in the unit frame, may hold it.
inline constexpr double kNearPlane = 1e-9;

// Fronts less backs of the faces that a direction meets, the same for all directions of a closed
// mesh; none if all of a few directions meet edges.
std::optional<int> surplus_of(const LocalView& view, const Vec3& center, const Context& context);

// How often each of n directions meets the surface of a closed mesh; none if the centre
// may lie on the surface, or all of a few directions from which to begin on edges. `low`: all faces
// with d_T < kNearPlane, in order; others may be among them.
std::optional<std::vector<int>> count_meetings(const LocalView& view, const Vec3& center,
                                               std::size_t n, const std::vector<std::uint32_t>& low,
                                               const Context& context);

}  // namespace rholm
