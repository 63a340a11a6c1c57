// Names of inputs: streams, extensions, and how messages show them. Layer: cli.
#pragma once

#include <string>

namespace rholm::cli {

// Standard input, a pipe or the like: what can be read once only.
bool is_stream(const std::string& path);

// The name in messages: "standard input" for "-".
std::string display_name(const std::string& path);

// Lower case, with the dot: ".ply"; empty without one.
std::string extension_of(const std::string& path);

}  // namespace rholm::cli
