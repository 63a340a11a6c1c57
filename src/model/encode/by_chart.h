// Encoding a mesh that has to be changed first: welded, turned, its edges paired. Layer: model.
#pragma once

#include "rholm/model.h"

namespace rholm {

// As encode(), whether or not the mesh could be taken as it lies. The mesh must be valid.
Encoded encode_by_chart(const Mesh& mesh, const EncodeOptions& options, const Context& context);

}  // namespace rholm
