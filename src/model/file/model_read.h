// The model file from bytes in memory. Layer: model, private.
#pragma once

#include <span>
#include <string>

#include "io/hdf5/hdf5_values.h"
#include "rholm/coefficients.h"

namespace rholm {

// What read_model() does with the file's bytes; `name` serves messages.
Expansion parse_model(std::span<const char> bytes, const std::string& name);
bool looks_like_model(std::span<const char> bytes);

// Throws Unsupported unless the file says that it is a model of this major version.
void check_model_version(const hdf5::File& file, const hdf5::Object& root);

}  // namespace rholm
