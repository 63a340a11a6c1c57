// What both ways of encoding put into their result. Layer: model.
#pragma once

#include "rholm/model.h"
#include "transform/error/error_sites.h"

namespace rholm {

// What a search for a degree has found; `encoded` keeps the times it has.
void set_found(ToleranceAnalysis found, const EncodeOptions& options, Encoded& encoded);

// Measures the errors of the surface, unless they are not wanted or a search has done so.
// `sites`: of the mesh about the centre of its expansion; `predict`: the largest ones from the
// edges as well.
void add_errors(ErrorSites& sites, bool predict, const EncodeOptions& options,
                const Context& context, Encoded& encoded);

}  // namespace rholm
