// Texts that come from outside, as they may be shown, and stand in lines of commands. Layer:
// studio.
#pragma once

#include <string>
#include <string_view>

#include "base/plain_text.h"

namespace rholm::studio {

// Without bytes that are not UTF-8, and without what does not print: control characters, line and
// paragraph separators, and marks that turn the direction of writing.
std::string plain_text(std::string_view text);

// The last part of a path as plain text, at most 200 bytes; "shape" if nothing is left.
std::string plain_name(const std::string& name);

// Whether it is plain text, and the name of a file of the folder where one is: no path.
bool is_file_name(const std::string& text);

// Whether Python takes it as the name of a variable, and rholm does not need it.
bool is_variable(const std::string& text);
// The same with a '_' behind what Python or rholm needs. Letters, digits and '_' are expected.
std::string free_variable(const std::string& text);

// As Python reads it back. Shells: base/plain_text.h.
std::string python_text(const std::string& text);

}  // namespace rholm::studio
