// Lines of a shell and of Python that repeat the steps of a session. Layer: studio.
//
// A session stores steps; their lines are made from them only here. A file with steps therefore
// cannot contain lines that no step has.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "rholm/vec3.h"
#include "studio/items/item.h"
#include "studio/names.h"

namespace rholm::studio {

// Name of a result in the lines: a file, and a Python variable.
struct Named {
  std::string file, variable;
};
Json json_of(const Named& named);

struct Recipe {
  std::vector<Json> steps;                 // in the form that step_lines() takes
  std::vector<std::string> shell, python;  // their lines
  std::set<std::string> files, variables;  // used names

  // Returns an unused name and marks it as used: "bumpy-2.ply" for "bumpy" and ".ply".
  std::string file(const std::string& stem, const std::string& ending);
  std::string variable(const std::string& stem);  // the same for Python: "bumpy_2"

  // Adds a step with its lines, and marks the names it
  // makes as used. Throws the errors of step_lines().
  void add(const Json& step);
  // Returns true if earlier lines make this variable, or surface of caps: "bumpy_caps.mesh()".
  bool has_variable(const std::string& expression) const;
};

struct StepLines {
  std::vector<std::string> shell, python;
  std::vector<Named> made;
};

// Returns the lines of a step {"op": ..., "from": NAMED, "made": NAMED, ...}; its
// other fields are as in its request (docs/studio.md). The step is untrusted: file
// names must be plain, and variables must come from an earlier line. All other fields
// are read like requests, and quoted. Throws Refusal 400, Error{kInvalidInput}.
StepLines step_lines(const Json& step, const Recipe& before);

// Returns the shortest digits that give the same number when read.
std::string digits(double value);

// Returns "bumpy" for "folder/bumpy.ply".
std::string stem_of(const std::string& name);

// Returns the file and variable of an item's shown surface. Adds
// the lines that make the surface if it comes from a series.
Named surface_of(Recipe& recipe, const Item& item);
// Returns the file and variable of the item's coefficients, filtered as shown.
Named model_of(Recipe& recipe, const Item& item);

// Returns the recipe, with lines for shown surfaces of cut off or filtered series.
Recipe with_looks(Recipe recipe, std::span<const ItemPtr> items);

// Sets the names of an item from a file, and adds the Python line that reads it.
void add_reading(Recipe& recipe, Item& item);

}  // namespace rholm::studio
