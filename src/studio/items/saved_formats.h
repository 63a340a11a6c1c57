// Formats in which an item can be saved. Layer: studio.
#pragma once

#include <string>
#include <vector>

#include "rholm/formats.h"
#include "studio/items/item.h"

namespace rholm::studio {

struct SavedFormat {
  const FileFormat* file = nullptr;  // entry of a table of formats; always valid
  std::string label = {};            // for display: "Mesh, PLY"
  bool is_shape = false;             // true for meshes and points, false for coefficients
};
// Returns the formats in the order of the menu.
std::vector<SavedFormat> saved_formats(const Item& item);

}  // namespace rholm::studio
