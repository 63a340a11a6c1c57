// Finds where a surface turns around within a given length. Layer: surface.
#pragma once

#include <cstdint>
#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/normal_attributes.h"

namespace rholm {

struct SharpVertex {
  Vec3 at, normal;
};
// Returns, ascending, the ends of edges along which the normal turns
// as fast as the average on a closed curve of `length`. In a part of a
// mesh, edges to vertices from `n_own` on may have one triangle only.
std::vector<std::uint32_t> sharp_vertices(const Mesh& mesh, const NormalAttributes& normals,
                                          double length, std::size_t n_own, const Context& context);
// Returns, ascending, the indices of sharp vertices that are tight places as defined below.
std::vector<std::uint32_t> turning_around(const std::vector<SharpVertex>& sharp, double length);

// Returns vertices, ascending, found by their normals. Nearly every closed curve
// of at most `length` that is the shortest around something passes one of them.
std::vector<std::uint32_t> tight_places(const Mesh& mesh, const NormalAttributes& normals,
                                        double length, const Context& context);

}  // namespace rholm
