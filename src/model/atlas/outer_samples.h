// Samples of the outer surface of a mesh whose parts may intersect each other. Layer: model,
// private.
#pragma once

#include <cstddef>
#include <cstdint>

#include "reconstruct/points/oriented_points.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "shape/queries/ray_scene.h"

namespace rholm {

struct OuterSurface {
  const Mesh& mesh;
  const RayScene& scene;  // rays in the mesh
  bool closed = false;    // an open mesh has only outer samples
  std::uint64_t seed = 1;
};

struct SheetProbe {
  double gap = 0;     // between facing sheets: smaller on the share `thin` of the area
  double hidden = 0;  // share of the area that is inside the solid
};

// Probes five thousand points. Throws InvalidInput if parts of the mesh are inside out.
SheetProbe probe_sheets(const OuterSurface& surface, double thin, const Context& context);

// Returns the outer ones of `n` points spread by area, with the normals of their triangles.
OrientedPoints outer_samples(const OuterSurface& surface, std::size_t n, const Context& context);

}  // namespace rholm
