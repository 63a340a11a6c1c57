// Values that are written as lists: degrees, sizes, vectors. Layer: cli.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "rholm/vec3.h"

namespace rholm::cli {

// Each throws UsageError with `option` (as typed) and the text if it does not fit.
std::vector<int> parse_degrees(const std::string& option, const std::string& text);  // "4,16"
std::array<int, 2> parse_size(const std::string& option, const std::string& text, int min,
                              int max);                                 // "1024x768"
Vec3 parse_vector(const std::string& option, const std::string& text);  // "1,-2.5,3"
std::vector<double> parse_numbers(const std::string& option, const std::string& text,
                                  std::size_t count);  // "1,0.3"
// The whole text as a finite number, if it is one.
std::optional<double> read_number(const std::string& text);
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace rholm::cli
