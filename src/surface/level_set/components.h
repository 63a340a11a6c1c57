// Removes small components of an extracted surface. Layer: surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/shared_sets.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// Returns the sets of vertices that triangles connect.
SharedSets connected_vertices(const Mesh& mesh, const Context& context);
// Returns the first member of each set.
std::vector<std::uint32_t> first_members(const SharedSets& sets, const Context& context);

// Sums over the triangles of a component.
struct ComponentSize {
  Vec3 area_vector;
  double area = 0;
  double volume = 0;  // valid if the component is closed
};

// Returns 1 for each component that stays by the rule below, and 0 for the others.
std::vector<char> large_components(std::span<const ComponentSize> sizes, double least_share);

struct DroppedComponents {
  std::size_t components = 0;  // number before dropping
  std::size_t dropped = 0;
  double dropped_area = 0;  // share of the total area before dropping
};

// Drops components (triangles connected through vertices) with an area below `least_share`
// of the largest, and closed ones with a volume below least_share^(3/2) of the largest
// volume. Both rules agree for bodies of one shape, but a flat bubble has little volume. 0
// drops nothing. The order is kept; vertices without triangles are removed.
DroppedComponents drop_small_components(Mesh& mesh, double least_share,
                                        const Context& context = {});

}  // namespace rholm
