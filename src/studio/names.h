// Prepares texts from outside for display
// and for lines of commands. Layer: studio.
#pragma once

#include <string>
#include <string_view>

#include "base/plain_text.h"

namespace rholm::studio {

// Removes bytes that are not UTF-8, and unprintable characters: control characters,
// line and paragraph separators, and marks that change the writing direction.
std::string plain_text(std::string_view text);

// Returns the last part of a path as plain text, at most 200 bytes; "shape" if it is empty.
std::string plain_name(const std::string& name);

// Returns true if `text` is plain text and the name of a file without a folder.
bool is_file_name(const std::string& text);

// Returns true if Python accepts `text` as a variable, and rholm does not use it.
bool is_variable(const std::string& text);
// Appends '_' to names that Python or rholm use. Letters, digits and '_' are expected.
std::string free_variable(const std::string& text);

// Returns a Python literal of the text. Shells: base/plain_text.h.
std::string python_text(const std::string& text);

}  // namespace rholm::studio
