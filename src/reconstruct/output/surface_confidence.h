// Confidence of a surface: how much of it the points show. Layer: reconstruct.
#pragma once

#include "atlas/cover/cap_cover.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/reconstruct.h"

namespace rholm {

// Areas of a surface, or of a part of it.
struct ConfidenceAreas {
  double all = 0, unseen = 0, thin = 0, unsure = 0;
};
ConfidenceAreas& operator+=(ConfidenceAreas& sum, const ConfidenceAreas& part);
// Writes the shares of the whole area into the report.
void put_areas(const ConfidenceAreas& areas, ReconstructReport& report);

// Multiplies the attribute `confidence` of the mesh's vertices, which is the confidence of the
// signs of normals, by two factors. One is 1 up to two spacings from the nearest point, and 0 from
// four spacings on. The other is the distance to an opposite sheet of points over three spacings,
// at most 1. Returns the areas of the mesh's triangles.
ConfidenceAreas add_confidence(const OrderedPoints& all, Mesh& mesh, const Context& context);

}  // namespace rholm
