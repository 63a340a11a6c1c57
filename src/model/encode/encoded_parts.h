// What both ways of encoding put into their result. Layer: model.
#pragma once

#include "rholm/mesh_view.h"
#include "rholm/model.h"

namespace rholm {

// What a search for a degree has found; `encoded` keeps the times it has.
void set_found(ToleranceAnalysis found, const EncodeOptions& options, Encoded& encoded);

// Measures the errors of the surface, unless they are not wanted or a search has done so.
// `predict`: the largest ones from the edges as well.
void add_errors(const MeshView& mesh, bool predict, const EncodeOptions& options,
                const Context& context, Encoded& encoded);

}  // namespace rholm
