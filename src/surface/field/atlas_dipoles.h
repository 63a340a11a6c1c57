// Represents an atlas by oriented points, each with its share of the area. Layer: surface.
#pragma once

#include <vector>

#include "rholm/atlas.h"
#include "rholm/context.h"
#include "surface/holes/hole_fill.h"

namespace rholm {

// Replaces an atlas's potential where no cap has a weight. `feet` are foot points for the
// borders of holes; `area_normals[i]` is the dipole at points[i], for the winding number.
struct AtlasDipoles {
  std::vector<FootPoint> feet;
  std::vector<Vec3> points, area_normals;
};

// Spreads points about `spacing` apart over each cap's surface, where the cap
// has a weight within `band`. Where several caps have a weight, they share the
// area by their weights. The support of a foot point is at most `spacing`.
AtlasDipoles spread_dipoles(const Atlas& atlas, double spacing, double band,
                            const Context& context);

}  // namespace rholm
