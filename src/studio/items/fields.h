// JSON of requests and answers. Layer: studio.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace rholm::studio {

using Json = nlohmann::ordered_json;

// Returns the text of an answer; invalid UTF-8 is replaced, non-finite numbers become null.
std::string text_of(const Json& json);
// Parses an object. Throws Refusal 400.
Json parse_object(std::string_view text);

// Return fields of a request. Each throws Refusal 400 with the name of a field that is missing
// or of another type. Functions with a fallback return it for a missing or null field.
bool has_field(const Json& json, const char* name);  // false if missing or null
double number_of(const Json& json, const char* name);
double whole_number_of(const Json& json, const char* name);  // all digits fit into a double
double number_or(const Json& json, const char* name, double fallback);
std::optional<double> maybe_number(const Json& json, const char* name);
int integer_of(const Json& json, const char* name);
int integer_or(const Json& json, const char* name, int fallback);
bool flag_of(const Json& json, const char* name);  // false if missing
std::string string_of(const Json& json, const char* name);
std::string string_or(const Json& json, const char* name, const std::string& fallback);
std::vector<double> numbers_of(const Json& json, const char* name);  // empty if missing
std::vector<std::string> strings_of(const Json& json, const char* name);

}  // namespace rholm::studio
