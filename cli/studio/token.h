// What an address must have in it. Layer: cli.
#pragma once

#include <string>
#include <string_view>

namespace rholm::cli {

// 32 hexadecimal digits of the system's randomness. Throws Io where there is none.
std::string random_token();

// In a time that does not tell how much of them is equal.
bool is_same(std::string_view a, std::string_view b);

}  // namespace rholm::cli
