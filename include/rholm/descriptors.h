// Descriptors: characteristic numbers of a surface, each declared once. Layer: surface.
#pragma once

#include <optional>
#include <span>

#include "rholm/synthesize.h"

namespace rholm {

// A number that describes the solid and does not change when the shape is moved or rotated. The
// tables of rholm info, batches, Python and docs/reference.md come from descriptors().
struct Descriptor {
  const char* name;        // key in JSON, column of a batch, property in Python
  int length_power;        // its unit is the unit of length to this power
  const char* definition;  // one sentence without a full stop
  const char* source;      // publication that defined it; empty for a common notion
  // Returns the number; nothing where the measures do not determine it.
  std::optional<double> (*value)(const SurfaceMeasures& measures);
};
// Returns all descriptors, each once.
std::span<const Descriptor> descriptors();

}  // namespace rholm
