// Files that people give to a session. Layer: studio.
#pragma once

#include <string>
#include <string_view>

#include "studio/items/item.h"
#include "studio/recipe.h"
#include "studio/scratch.h"

namespace rholm::studio {

// What the bytes hold: a mesh, points, an expansion or an atlas, in any format that the program
// reads. The item has its name and the unit of its file. `columns` are those of a text table of
// points, as in ShapeReadOptions; nothing else has any. Throws what the readers throw.
Item open_item(const std::string& name, std::string_view bytes, Scratch& scratch,
               const Context& context, const std::string& columns = {});
// The points of a table with other columns: without a number, and without names for the recipe.
Item open_table(const Table& table, const std::string& columns, const Context& context);

// Its names in the recipe, which reads the table with these columns.
void record_columns(Recipe& recipe, Item& item, const std::string& columns);

}  // namespace rholm::studio
