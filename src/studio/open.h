// Files that people give to a session. Layer: studio.
#pragma once

#include <string>
#include <string_view>

#include "studio/items/item.h"
#include "studio/scratch.h"

namespace rholm::studio {

// What the bytes hold: a mesh, points, an expansion or an atlas, in any format that the program
// reads. The item has its name and the unit of its file. Throws what the readers throw.
Item open_item(const std::string& name, std::string_view bytes, Scratch& scratch,
               const Context& context);

}  // namespace rholm::studio
