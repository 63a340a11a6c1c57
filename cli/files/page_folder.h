// Folder with the results of scripts/studio. Layer: cli.
#pragma once

#include <optional>
#include <string>

namespace rholm::cli {

// Returns the folder of the installed program (PREFIX/share/rholm/studio, with pip too) or of its
// build tree (web/dist); nothing if both are missing.
std::optional<std::string> page_folder();

// Returns the JavaScript of the viewer in that folder. Throws Unsupported if it is missing.
std::string viewer_script();

}  // namespace rholm::cli
