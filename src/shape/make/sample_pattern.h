// Computes places on a surface in the patterns of measuring devices. Layer: shape.
#pragma once

#include <vector>

#include "rholm/context.h"
#include "rholm/points.h"
#include "shape/make/surface_places.h"

namespace rholm {

// Returns about options.points places of kSlices, kRings or kGrid, before thinning by density.
std::vector<SurfacePlace> pattern_places(const SampledSurface& surface,
                                         const SampleOptions& options, const Context& context);

// The axis of a pattern and two directions perpendicular to it: an orthonormal frame.
struct PatternFrame {
  Vec3 axis, u, v;
};
PatternFrame pattern_frame(const SampleOptions& options);

}  // namespace rholm
