// An atlas as oriented points, each for its part of the surface. Layer: surface.
#pragma once

#include <vector>

#include "rholm/atlas.h"
#include "rholm/context.h"
#include "surface/holes/hole_fill.h"

namespace rholm {

// What takes the place of an atlas's potential where no cap has a weight: foot points for the
// borders of holes, and dipoles for the winding number, area_normals[i] at feet[i].at.
struct AtlasDipoles {
  std::vector<FootPoint> feet;
  std::vector<Vec3> points, area_normals;
};

// Points about `spacing` apart on each cap's surface, where it has a weight within `band` of
// itself; where several caps have one they share the area by their weights. A support is the
// spacing at most.
AtlasDipoles spread_dipoles(const Atlas& atlas, double spacing, double band,
                            const Context& context);

}  // namespace rholm
