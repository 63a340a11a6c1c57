// The secret part of an address. Layer: cli.
#pragma once

#include <string>
#include <string_view>

namespace rholm::cli {

// Returns 32 random hexadecimal digits from the system. Throws Io if it has none.
std::string random_token();

// Compares in a time that does not depend on how many characters are equal.
bool is_same(std::string_view a, std::string_view b);

}  // namespace rholm::cli
