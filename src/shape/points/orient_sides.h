// Which side of oriented parts is the outer one. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/orient_graph.h"
#include "shape/queries/winding_tree.h"

namespace rholm {

// How nearly the winding number of all is 1 behind and 0 before the points, 0 ... 1.
struct SideTrust {
  std::vector<double> of_component;
  double doubtful = 0;  // share of the points where it is less than a half
};

// The surface that each point stands for.
struct Patches {
  std::vector<double> areas;
  // The side of a square patch of even points; of rows, the way across.
  std::vector<double> spacing;
};

// Turns components, and pieces of them that were joined in doubt, as a whole: to enclose a
// positive volume, and so that the winding number of all falls from 1 to 0 along the normals.
SideTrust turn_outwards(std::span<const Vec3> points, const Patches& patches,
                        const OrientedParts& parts, std::vector<Vec3>& normals,
                        const Context& context);

// The same share for any normals, asked nearer to the points, where thin parts are seen too, and
// the pattern of the points a little. To compare.
double doubtful_share(std::span<const Vec3> points, const Patches& patches,
                      std::span<const Vec3> normals, const Context& context);

// Radii of a patch behind and before points: turn_outwards() asks where the field of a patch is
// clear of jumps, doubtful_share() nearer.
inline constexpr double kClearOfPatches = 2, kNearPatches = 1.5;
// Of the `chosen` points, how many are doubtful: asked so many radii away.
std::size_t count_doubtful(const WindingNumbers& winding, std::span<const Vec3> points,
                           const Patches& patches, std::span<const Vec3> normals,
                           std::span<const std::uint32_t> chosen, double radii);

// The same trust at every point.
std::vector<double> trust_in_sides(std::span<const Vec3> points, const Patches& patches,
                                   std::span<const Vec3> normals, const Context& context);

}  // namespace rholm
