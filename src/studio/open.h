// Files that people give to a session. Layer: studio.
#pragma once

#include <string>
#include <string_view>

#include "studio/items/item.h"
#include "studio/scratch.h"

namespace rholm::studio {

// The last part of a path, without letters that do not print, at most 200 bytes; "shape" if nothing
// is left.
std::string plain_name(const std::string& name);

// What the bytes hold: a mesh, points, an expansion or an atlas, in any format that the program
// reads. The item has its name and the unit of its file. Throws what the readers throw.
Item open_item(const std::string& name, std::string_view bytes, Scratch& scratch,
               const Context& context);

}  // namespace rholm::studio
