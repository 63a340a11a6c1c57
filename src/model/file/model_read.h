// The model file from bytes in memory. Layer: model, private.
#pragma once

#include <span>
#include <string>

#include "rholm/coefficients.h"

namespace rholm {

// What read_model() does with the file's bytes; `name` serves messages.
Expansion parse_model(std::span<const char> bytes, const std::string& name);

}  // namespace rholm
