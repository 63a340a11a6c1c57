// Splits a patch of a surface into a base and detail on it. Layer: edit.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "edit/region/local_mesh.h"
#include "edit/texture/detail_map.h"
#include "rholm/atlas.h"
#include "rholm/smooth.h"

namespace rholm {

// Coordinates on a patch, in the azimuth seen from the centre: angle from the axis times
// the radius of the frame, in units of `unit`. On a sphere they are lengths along it.
struct PatchChart {
  CapFrame frame;
  double unit = 1;  // radius of the patch
  Place2 operator()(const Vec3& x) const;
};

inline constexpr std::uint32_t kNoRow = 0xffffffff;
struct TexturedPatch {
  double wavelength = 0;
  Patch patch;
  LocalMesh local;
  std::vector<std::uint32_t> row;   // row of each point in the patch; kNoRow for other points
  std::vector<Vec3> base, normals;  // position and normal of the smooth surface at each point
  PatchChart chart;
  // Returns true if all corners of a triangle of `local` are in the patch.
  bool whole(const Triangle& t) const {
    return row[t[0]] != kNoRow && row[t[1]] != kNoRow && row[t[2]] != kNoRow;
  }
};

// Returns the radius of a disc with the area of the regions.
double region_radius(const Mesh& mesh, std::span<const Region> regions);

// Computes the base: the surface without waves shorter than `wavelength`.
// Throws InvalidInput for regions that are not visible from one side.
TexturedPatch texture_of(const Mesh& mesh, std::span<const Region> regions, double wavelength,
                         double transition, const Context& context);

// Sets the zero azimuth of `chart` to the zero azimuth of `like`, after the shortest turn between
// both axes. A texture laid over without a further turn then stays as upright as possible.
void count_azimuths_like(const PatchChart& like, PatchChart& chart);

// Returns the height of the surface over its base, on
// the patch's chart, with samples half an edge apart.
DetailMap detail_of(const TexturedPatch& textured);

}  // namespace rholm
