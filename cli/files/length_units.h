// Common unit of several models whose files state different units of length. Layer: cli.
#pragma once

#include <string>

#include "cli/files/inputs.h"
#include "cli/terminal/session.h"
#include "rholm/coefficients.h"

namespace rholm::cli {

// Converts `expansion` from file `path` to the unit of the file `other_path`, with a note. If one
// file states no unit, the units are assumed equal, with a warning. Throws InvalidInput for
// different units that cannot be converted.
void bring_to_unit(Expansion& expansion, const std::string& path, const std::string& unit,
                   const std::string& other_path, Session& session);

// The common unit of several surfaces: the unit of the first file of coefficients. Meshes have no
// unit in their files and are assumed to be in this unit.
class CommonUnit {
 public:
  // Converts one more surface to the unit, or adopts its unit if it is the first.
  void add(Input& input, const std::string& path, Session& session);

 private:
  std::string unit_, path_;
};

}  // namespace rholm::cli
