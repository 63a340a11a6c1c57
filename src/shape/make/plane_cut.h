// Points along the curves in which planes cut a surface. Layer: shape.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/make/surface_places.h"

namespace rholm {

// The points x with normal . x = height.
struct Plane {
  Vec3 normal;  // unit
  double height = 0;
};

// Keeps a reference to the surface. Vertices at one place are one, whatever triangles say.
class PlaneCutter {
 public:
  explicit PlaneCutter(const SampledSurface& surface);

  // Places at equal steps, about `step`, along each curve, at least one on each, from a random one
  // on. In frames of the surface.
  std::vector<SurfacePlace> places(const Plane& plane, double step, RandomStream& random) const;

 private:
  const SampledSurface& surface_;
  std::vector<std::uint32_t> vertex_;  // per vertex of the mesh: the first at its place
};

}  // namespace rholm
