// Common definitions for all JSON of the program. Layer: cli.
#pragma once

#include <nlohmann/json.hpp>

#include "rholm/vec3.h"

namespace rholm::cli {

// Keys in the order they are added. A number that is not finite is written as null.
using Json = nlohmann::ordered_json;

inline Json json_of(const Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace rholm::cli
