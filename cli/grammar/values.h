// Values that are written as lists: degrees, sizes, vectors. Layer: cli.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rholm/vec3.h"

namespace rholm::cli {

// Parse a value; throw UsageError with `option` (as typed) and the text if it does not fit.
std::vector<int> parse_degrees(const std::string& option, const std::string& text);  // "4,16"
// Returns a size with at most kMaxGridVertices in all, each side at least `min`.
std::array<int, 2> parse_grid(const std::string& option, const std::string& text,
                              std::array<int, 2> min);  // "90x180"
std::array<int, 2> parse_size(const std::string& option, const std::string& text, int min,
                              int max);                                 // "1024x768"
Vec3 parse_vector(const std::string& option, const std::string& text);  // "1,-2.5,3"
std::vector<double> parse_numbers(const std::string& option, const std::string& text,
                                  std::size_t count);  // "1,0.3"
std::vector<double> parse_positive(const std::string& option, const std::string& text,
                                   std::size_t count);  // "3,2,1"
// Returns a vector other than 0,0,0, scaled so that its largest component is 1 or -1.
Vec3 parse_direction(const std::string& option, const std::string& text);
std::vector<int> parse_band(const std::string& option, const std::string& text);  // "10,40"
// Returns the whole text as a finite number, if it is one.
std::optional<double> read_number(const std::string& text);
// Read the whole text as a whole number; return false if it is none, or too large for the type.
bool read_whole(const std::string& text, int& number);
bool read_whole(const std::string& text, std::uint64_t& number);
// Runs `look` on a value that the library checks; its exception becomes a UsageError.
void check_by(const std::string& option, const std::string& text,
              const std::function<void()>& look);
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace rholm::cli
