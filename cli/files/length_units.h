// Models laid on each other whose files say different units of length. Layer: cli.
#pragma once

#include <string>

#include "cli/files/inputs.h"
#include "cli/terminal/session.h"
#include "rholm/coefficients.h"

namespace rholm::cli {

// Brings `expansion`, of the file `path`, to the unit that the file `other_path` says, and says so.
// Where one of the two has none, they are taken to be the same, with a warning. Throws
// InvalidInput for different units that cannot be converted.
void bring_to_unit(Expansion& expansion, const std::string& path, const std::string& unit,
                   const std::string& other_path, Session& session);

// What several surfaces are laid in: the unit of the first file of coefficients. Files of meshes
// have no place for one; they are taken to be in it.
class CommonUnit {
 public:
  // Brings one more surface to it, or takes its unit.
  void add(Input& input, const std::string& path, Session& session);

 private:
  std::string unit_, path_;
};

}  // namespace rholm::cli
