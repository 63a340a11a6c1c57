// The model file of an atlas from bytes in memory. Layer: reconstruct, private.
#pragma once

#include <span>
#include <string>

#include "rholm/atlas_model.h"

namespace rholm {

// Reads an atlas from a file's bytes, as read_atlas() does; `name` serves messages.
AtlasModel parse_atlas(std::span<const char> bytes, const std::string& name);

}  // namespace rholm
