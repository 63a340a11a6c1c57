// The lines of a shell, and of Python, that do what has been done in a session. Layer: studio.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "rholm/vec3.h"
#include "studio/items/item.h"

namespace rholm::studio {

struct Recipe {
  std::vector<std::string> shell, python;  // lines
  std::set<std::string> files, variables;  // names that are taken

  // A name that is not taken yet, and now is: "bumpy-2.ply" for "bumpy" and ".ply".
  std::string file(const std::string& stem, const std::string& ending);
  std::string variable(const std::string& stem);  // the same for Python: "bumpy_2"
};

// A word as a shell, and a text as Python, reads it back.
std::string shell_word(const std::string& word);
std::string python_text(const std::string& text);
std::string python_list(const std::vector<std::string>& texts);
// The shortest digits that read back the same.
std::string digits(double value);

// "bumpy" of "folder/bumpy.ply".
std::string stem_of(const std::string& name);

// The file, and the variable, with the surface of an item as it is shown; lines that make it are
// added where it is the surface of a series.
struct Named {
  std::string file, variable;
};
Named surface_of(Recipe& recipe, const Item& item);
// The same of its coefficients, filtered as it is shown.
Named model_of(Recipe& recipe, const Item& item);

// The recipe, and lines that make what is shown of series that are cut off or filtered.
Recipe with_looks(Recipe recipe, std::span<const ItemPtr> items);

// Gives an item that came from a file its names, with the line of Python that reads it.
void add_reading(Recipe& recipe, Item& item);

}  // namespace rholm::studio
