// Opens files in a session. Layer: studio.
#pragma once

#include <string>
#include <string_view>

#include "studio/items/item.h"
#include "studio/recipe.h"
#include "studio/scratch.h"

namespace rholm::studio {

// Opens a mesh, points, an expansion or an atlas in any format of the program. The item
// has its name and the unit of its file. `columns` are the columns of a text table of
// points, as in ShapeReadOptions; other files have none. Throws the errors of the readers.
Item open_item(const std::string& name, std::string_view bytes, Scratch& scratch,
               const Context& context, const std::string& columns = {});
// Returns the points of a table with other columns, without a number and recipe names.
Item open_table(const Table& table, const std::string& columns, const Context& context);

// Records the columns in the recipe and sets the item's names there.
void record_columns(Recipe& recipe, Item& item, const std::string& columns);

}  // namespace rholm::studio
