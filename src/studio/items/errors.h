// What is known of the errors of a model that is cut off. Layer: studio.
#pragma once

#include <optional>

#include "studio/items/model.h"

namespace rholm::studio {

// The rms error of the radius, cut off at a degree: by the norm, or as it was measured, which is
// known of all degrees together only. None where nobody knows it.
std::optional<double> rms_at(const Model& model, int degree);

}  // namespace rholm::studio
