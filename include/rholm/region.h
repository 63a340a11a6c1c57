// Regions of a mesh's surface, for edits. Layer: edit.
//
// A region holds vertices. Around it lies a transition, where an edit fades: a weight falls from 1
// in the region to 0, smoothly (twice continuously differentiable in the distance), and an edit
// leaves whatever has weight 0 as it is, to the last bit.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "rholm/mesh.h"
#include "rholm/vec3.h"

namespace rholm {

// Vertices within `radius` of a point in space. Distance is in space.
struct BallRegion {
  Vec3 center = {};   // any point
  double radius = 0;  // > 0
};
// Vertices within `radius` of a vertex, along the surface, and so is the distance.
struct DiscRegion {
  std::uint32_t vertex = 0;  // its index
  double radius = 0;         // > 0
};
// Vertices in a box. Distance is in space.
struct BoxRegion {
  Vec3 min = {}, max = {};  // corners, min <= max in each coordinate
};
// By an attribute. Values other than 0 and 1 make it a weight: it is the edit's, kept within 0 ...
// 1, and there is no further transition. Else the vertices of value 1, and distance along the
// surface.
struct PropertyRegion {
  std::string name = {};  // of an attribute of the mesh
};
// Vertices painted in this colour, 0xRRGGBB (attributes red, green, blue; 0 ... 255, or 0 ... 1
// where they are no whole numbers). Distance along the surface.
struct ColorRegion {
  std::uint32_t rgb = 0;  // 0xRRGGBB
};
// Any of these.
using Region = std::variant<BallRegion, DiscRegion, BoxRegion, PropertyRegion, ColorRegion>;

// Reads "ball:X,Y,Z,R", "vertex:INDEX,RADIUS", "box:X0,Y0,Z0,X1,Y1,Z1" (any two opposite corners),
// "property:NAME", "color:RRGGBB". Throws InvalidInput with the text and the form it should have.
Region parse_region(const std::string& text);

// The weight of every vertex in the union of the regions, 1 - prod (1 - w_i), with a transition of
// that width >= 0. Throws InvalidInput for a region without a vertex (and says how far the nearest
// is), for an attribute or a vertex that is not there, a radius that is not positive.
std::vector<double> region_weights(const Mesh& mesh, std::span<const Region> regions,
                                   double transition);

}  // namespace rholm
