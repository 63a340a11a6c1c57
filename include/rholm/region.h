// Regions of a mesh's surface for editing. Layer: edit.
//
// A region contains vertices. In the transition around it an edit fades: its weight falls from 1 to
// 0, twice continuously differentiable in the distance. An edit leaves every vertex of weight 0
// unchanged to the last bit.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/vec3.h"

namespace rholm {

// Vertices within `radius` of a point. The transition's distance is measured in space.
struct BallRegion {
  Vec3 center = {};   // any point
  double radius = 0;  // > 0
};
// Vertices within `radius` of a vertex. Both distances are measured along the surface.
struct DiscRegion {
  std::uint32_t vertex = 0;  // index of the vertex
  double radius = 0;         // > 0
};
// Vertices in a box. The transition's distance is measured in space.
struct BoxRegion {
  Vec3 min = {}, max = {};  // corners, min <= max in each coordinate
};
// Vertices by an attribute. If it has values other than 0 and 1, it is the weight itself, clamped
// to 0 ... 1, without a transition. Otherwise the region holds the vertices of value 1, and
// distance is measured along the surface.
struct PropertyRegion {
  std::string name = {};  // name of an attribute of the mesh
};
// Vertices painted in this colour (attributes red, green, blue; 0 ... 255, or 0 ... 1 if they are
// not whole numbers). Distance is measured along the surface.
struct ColorRegion {
  std::uint32_t rgb = 0;  // 0xRRGGBB
};
// Any of these regions.
using Region = std::variant<BallRegion, DiscRegion, BoxRegion, PropertyRegion, ColorRegion>;

// Parses "ball:X,Y,Z,R", "vertex:INDEX,RADIUS", "box:X0,Y0,Z0,X1,Y1,Z1" (any two opposite corners),
// "property:NAME", "color:RRGGBB". Throws InvalidInput with the text and the expected form.
Region parse_region(const std::string& text);

// Returns the weight of every vertex in the union of the regions, 1 - prod (1 - w_i), with a
// transition of width >= 0. Throws InvalidInput for a region without vertices (with the distance of
// the nearest one), a missing attribute or vertex, or a radius that is not positive.
std::vector<double> region_weights(const Mesh& mesh, std::span<const Region> regions,
                                   double transition);

}  // namespace rholm
