// The paper's own method from a star chart to its coefficients. Layer: paper.
#pragma once

#include "rholm/context.h"
#include "transform/methods/methods.h"

namespace rholm {

MethodResult curl_method(const StarGeometry& geometry, const MethodOptions& options,
                         const Context& context);

}  // namespace rholm
