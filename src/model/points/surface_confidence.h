// How much of a surface its points tell. Layer: model.
#pragma once

#include "atlas/cover/cap_cover.h"
#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/reconstruct.h"

namespace rholm {

// Multiplies the attribute `confidence` of the mesh's vertices, which has what is known of the
// signs of normals, by what the points around say: 1 up to two spacings from the nearest
// one, 0 from four on; and by the distance of an opposite sheet of points over three spacings where
// that is less. Writes the shares of the area to the report.
void add_confidence(const OrderedPoints& all, Mesh& mesh, ReconstructReport& report,
                    const Context& context);

}  // namespace rholm
