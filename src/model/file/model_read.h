// The model file from bytes in memory. Layer: model, private.
#pragma once

#include <span>
#include <string>

#include "rholm/coefficients.h"

namespace rholm {

// Parses the bytes of a file for read_model(); `name` is for messages.
Expansion parse_model(std::span<const char> bytes, const std::string& name);

}  // namespace rholm
