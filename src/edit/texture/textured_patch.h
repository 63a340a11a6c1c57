// A patch of a surface as a base and the detail on it. Layer: edit.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "edit/region/local_mesh.h"
#include "edit/texture/detail_map.h"
#include "rholm/atlas.h"
#include "rholm/smooth.h"

namespace rholm {

// Coordinates on a patch: angle from the axis, times the distance of the centre, in units of the
// patch's radius, in the azimuth seen from the centre. Of a sphere they are lengths along it.
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
  std::vector<std::uint32_t> row;   // of each point in the patch; kNoRow for others
  std::vector<Vec3> base, normals;  // of each point: where the smooth surface is, and its normal
  PatchChart chart;
  // Whether all corners of a triangle of `local` are in the patch.
  bool whole(const Triangle& t) const {
    return row[t[0]] != kNoRow && row[t[1]] != kNoRow && row[t[2]] != kNoRow;
  }
};

// The radius of a disc with the area of the regions.
double region_radius(const Mesh& mesh, std::span<const Region> regions);

// The base is the surface without waves shorter than `wavelength`. Throws InvalidInput for regions
// that cannot be seen from one side.
TexturedPatch texture_of(const Mesh& mesh, std::span<const Region> regions, double wavelength,
                         double transition, const Context& context);

// Azimuths of `chart` are counted from where the shortest turn between the axes puts those of
// `like`: what is laid over without a further turn stays as upright as it can.
void count_azimuths_like(const PatchChart& like, PatchChart& chart);

// Height of the surface over its base, over the chart of the patch, with samples half an edge
// apart.
DetailMap detail_of(const TexturedPatch& textured);

}  // namespace rholm
