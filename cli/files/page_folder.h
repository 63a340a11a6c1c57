// Where what scripts/studio makes is. Layer: cli.
#pragma once

#include <optional>
#include <string>

namespace rholm::cli {

// Of this program, installed (PREFIX/share/rholm/studio, by pip as well) or in the tree it was
// built in (web/dist); none if there is neither.
std::optional<std::string> page_folder();

// The JavaScript that shows an expansion in a page, of that folder. Throws Unsupported without one.
std::string viewer_script();

}  // namespace rholm::cli
