// The lines of a shell, and of Python, that do what has been done in a session. Layer: studio.
//
// A session has steps; their lines are made of them, here and nowhere else. So a file with steps
// cannot have other lines than those of what a step may be.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "rholm/vec3.h"
#include "studio/items/item.h"
#include "studio/names.h"

namespace rholm::studio {

// Where the lines have a thing: a file, and a variable of Python.
struct Named {
  std::string file, variable;
};
Json json_of(const Named& named);

struct Recipe {
  std::vector<Json> steps;                 // as step_lines() takes them
  std::vector<std::string> shell, python;  // their lines
  std::set<std::string> files, variables;  // names that are taken

  // A name that is not taken yet, and now is: "bumpy-2.ply" for "bumpy" and ".ply".
  std::string file(const std::string& stem, const std::string& ending);
  std::string variable(const std::string& stem);  // the same for Python: "bumpy_2"

  // A step with its lines; names that it makes are taken from now on. Throws what step_lines()
  // throws.
  void add(const Json& step);
  // Whether lines before have such a variable, or surface of caps: "bumpy_caps.mesh()".
  bool has_variable(const std::string& expression) const;
};

struct StepLines {
  std::vector<std::string> shell, python;
  std::vector<Named> made;
};

// The lines of one step: {"op": ..., "from": NAMED, "made": NAMED, ...}, its other fields as in the
// request for it (docs/studio.md). Nothing of it is believed: names of files are plain, variables
// are those that a line before has made, all else is read as requests are, and quoted. Throws
// Refusal 400, Error{kInvalidInput}.
StepLines step_lines(const Json& step, const Recipe& before);

// The shortest digits that read back the same.
std::string digits(double value);

// "bumpy" of "folder/bumpy.ply".
std::string stem_of(const std::string& name);

// The file, and the variable, with the surface of an item as it is shown; lines that make it are
// added where it is the surface of a series.
Named surface_of(Recipe& recipe, const Item& item);
// The same of its coefficients, filtered as it is shown.
Named model_of(Recipe& recipe, const Item& item);

// The recipe, and lines that make what is shown of series that are cut off or filtered.
Recipe with_looks(Recipe recipe, std::span<const ItemPtr> items);

// Gives an item that came from a file its names, with the line of Python that reads it.
void add_reading(Recipe& recipe, Item& item);

}  // namespace rholm::studio
