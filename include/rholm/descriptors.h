// Descriptors: figures of a surface, each declared once. Layer: surface.
#pragma once

#include <optional>
#include <span>

#include "rholm/synthesize.h"

namespace rholm {

// A figure of the solid that stays when the shape is moved or turned. rholm info, batches, Python
// and docs/reference.md have their descriptors from descriptors().
struct Descriptor {
  const char* name;        // of the key in JSON, the column of a batch, the property in Python
  int length_power;        // its unit is the unit of length to this power
  const char* definition;  // one sentence without a full stop
  const char* source;      // who defined it; empty for what everybody means by the name
  // Nothing where the measures do not tell.
  std::optional<double> (*value)(const SurfaceMeasures& measures);
};
// All descriptors, each once.
std::span<const Descriptor> descriptors();

}  // namespace rholm
