// Where a surface turns around within a length. Layer: surface.
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
// Vertices, ascending, from which an edge leaves along which the normal turns as fast as, on the
// average, along a closed curve of a length. Of a part of a mesh, whose edges to vertices from
// `n_own` on may have one triangle only.
std::vector<std::uint32_t> sharp_vertices(const Mesh& mesh, const NormalAttributes& normals,
                                          double length, std::size_t n_own, const Context& context);
// Those of all sharp vertices of a mesh, ascending, that are in the places below.
std::vector<std::uint32_t> turning_around(const std::vector<SharpVertex>& sharp, double length);

// Vertices, ascending, of which every closed curve on the surface of at most that length that is
// the shortest around something passes one, more or less: found by normals.
std::vector<std::uint32_t> tight_places(const Mesh& mesh, const NormalAttributes& normals,
                                        double length, const Context& context);

}  // namespace rholm
