// Finds the outer side of consistently oriented parts. Layer: shape.
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

// How close winding numbers are to 1 behind the points and 0 before them: trust 0 ... 1.
struct SideTrust {
  std::vector<double> of_component;
  double doubtful = 0;  // share of the points with a trust below a half
};

// The surface area that each point stands for.
struct Patches {
  std::vector<double> areas;
  // Side of a square patch in an even sampling; in rows, its length across the rows.
  std::vector<double> spacing;
};

// Flips whole components so that they enclose a positive volume. Flips pieces, joined by uncertain
// votes, so that the winding number of all points falls from 1 to 0 along the normals.
SideTrust turn_outwards(std::span<const Vec3> points, const Patches& patches,
                        const OrientedParts& parts, std::vector<Vec3>& normals,
                        const Context& context);

// Returns SideTrust::doubtful for any normals, for comparisons. It is evaluated nearer to the
// points, where thin parts count, and the pattern of the points has a little influence.
double doubtful_share(std::span<const Vec3> points, const Patches& patches,
                      std::span<const Vec3> normals, const Context& context);

// Distance of places behind and before points, in radii of a patch. In turn_outwards() the field of
// a patch has no jumps at this distance; doubtful_share() uses a smaller one.
inline constexpr double kClearOfPatches = 2, kNearPatches = 1.5;
// Counts the `chosen` points with a trust below a half, evaluated `radii` radii of a patch away.
std::size_t count_doubtful(const WindingNumbers& winding, std::span<const Vec3> points,
                           const Patches& patches, std::span<const Vec3> normals,
                           std::span<const std::uint32_t> chosen, double radii);

// Returns the trust at every point, evaluated at kNearPatches.
std::vector<double> trust_in_sides(std::span<const Vec3> points, const Patches& patches,
                                   std::span<const Vec3> normals, const Context& context);

}  // namespace rholm
