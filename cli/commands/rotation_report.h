// Rotations in reports: matrix, axis and angle. Layer: cli.
#pragma once

#include <string>

#include "cli/terminal/json_text.h"
#include "rholm/rotate.h"

namespace rholm::cli {

// Returns {"matrix": [[...], [...], [...]], "axis": [x, y, z], "angle": degrees}.
Json json_of(const Rotation& rotation);

// Returns lines "axis", "angle" and "matrix".
std::string text_of(const Rotation& rotation);

// Returns "12.5 degrees about (0, 0, 1)".
std::string turn_text(const Rotation& rotation);

}  // namespace rholm::cli
