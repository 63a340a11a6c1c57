// The formats that an item can be saved in. Layer: studio.
#pragma once

#include <string>
#include <vector>

#include "rholm/formats.h"
#include "studio/items/item.h"

namespace rholm::studio {

struct SavedFormat {
  const FileFormat* file = nullptr;  // of a table of formats: good for ever
  std::string label = {};            // for people: "Mesh, PLY"
  bool is_shape = false;             // of meshes and points; false: of coefficients
};
// In the order in which they are offered.
std::vector<SavedFormat> saved_formats(const Item& item);

}  // namespace rholm::studio
