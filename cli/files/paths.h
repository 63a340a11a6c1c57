// Names of inputs: streams, extensions, and names in messages. Layer: cli.
#pragma once

#include <string>

namespace rholm::cli {

// Returns true for standard input, a pipe or other input that can be read only once.
bool is_stream(const std::string& path);

// Returns the name in messages: "standard input" for "-".
std::string display_name(const std::string& path);

// Returns the extension in lower case, with dot: ".ply"; empty if there is none.
std::string extension_of(const std::string& path);

}  // namespace rholm::cli
