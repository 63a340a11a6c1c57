// The paper's own route from a star chart to its coefficients, and plain cubature. Layer: paper.
#pragma once

#include "rholm/context.h"
#include "transform/methods/methods.h"

namespace rholm {

MethodResult curl_method(const StarGeometry& geometry, const MethodOptions& options,
                         const Context& context);
MethodResult area_method(const StarGeometry& geometry, const MethodOptions& options,
                         const Context& context);

}  // namespace rholm
