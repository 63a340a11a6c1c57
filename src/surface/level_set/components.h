// Pieces of an extracted surface that are too small to be meant. Layer: surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/shared_sets.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

// Vertices that triangles connect.
SharedSets connected_vertices(const Mesh& mesh, const Context& context);
// The first of each set.
std::vector<std::uint32_t> first_members(const SharedSets& sets, const Context& context);

// Of a component's triangles.
struct ComponentSize {
  Vec3 area_vector;
  double area = 0;
  double volume = 0;  // if it is closed
};

// Which stay, 1 or 0 each, by the rule below.
std::vector<char> large_components(std::span<const ComponentSize> sizes, double least_share);

struct DroppedComponents {
  std::size_t components = 0;  // before
  std::size_t dropped = 0;
  double dropped_area = 0;  // as a part of the area before
};

// Drops components (of triangles connected through vertices) whose area is below `least_share` of
// the largest area, and closed ones whose enclosed volume is below least_share^(3/2) of the largest
// volume: of bodies of one shape, the two agree, but a flat bubble has little
// volume. 0 drops nothing. What is left keeps its order, vertices in no triangle go.
DroppedComponents drop_small_components(Mesh& mesh, double least_share,
                                        const Context& context = {});

}  // namespace rholm
