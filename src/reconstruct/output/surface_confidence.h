// How much of a surface its points tell. Layer: reconstruct.
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
// Their shares.
void put_areas(const ConfidenceAreas& areas, ReconstructReport& report);

// Multiplies the attribute `confidence` of the mesh's vertices, which has what is known of the
// signs of normals, by what the points around say: 1 up to two spacings from the nearest
// one, 0 from four on; and by the distance of an opposite sheet of points over three spacings where
// that is less. Returns the areas of the mesh's triangles.
ConfidenceAreas add_confidence(const OrderedPoints& all, Mesh& mesh, const Context& context);

}  // namespace rholm
