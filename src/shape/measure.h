// Computes sums over the triangles of a mesh: area, volume, centroids.
#pragma once

#include <cmath>

#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "shape/face.h"

namespace rholm {

// Area and signed volume from plain cross products, for meshes of many triangles. The error of a
// sliver's cross product is as small as its area.
struct Sizes {
  double area = 0, volume = 0;
};
Sizes measure_sizes(const MeshView& mesh, const UnitFrame& frame, const Context& context);

// Returns true if a sum of volumes is more than rounding. Each volume has a relative rounding of a
// few 2^-53; below 16 2^-53 of the moduli (chosen) no digit is correct.
inline bool has_volume(double six_volumes, double moduli) {
  return std::abs(six_volumes) > 0x1p-49 * moduli;
}

// Returns the centroid of the solid by plain sums, or the frame's middle if the volume is rounding.
Vec3 volume_centroid(const MeshView& mesh, const UnitFrame& frame, const Context& context);

// Results of compensated sums about the middle of the bounding box. Relative errors are a few ulp,
// also far from the origin. Results outside 1e-308 ... 1e308 become 0 or infinite.
struct Measures {
  double area = 0;
  double volume = 0;     // signed
  Vec3 area_centroid;    // middle of the bounding box if the area is zero
  Vec3 volume_centroid;  // middle of the bounding box if the volume is zero up to rounding
};
Measures measure(const MeshView& mesh, const UnitFrame& frame);

}  // namespace rholm
