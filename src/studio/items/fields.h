// JSON of requests and answers. Layer: studio.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace rholm::studio {

using Json = nlohmann::ordered_json;

// Text of an answer; bytes that are no UTF-8 are replaced, numbers that are not finite are null.
std::string text_of(const Json& json);
// An object. Throws Refusal 400.
Json parse_object(std::string_view text);

// Fields of a request. Each throws Refusal 400 with the name of a field that is not there or of
// another type; those with a fallback take it where the field is not there or null.
bool has_field(const Json& json, const char* name);  // and it is not null
double number_of(const Json& json, const char* name);
double whole_number_of(const Json& json, const char* name);  // all of whose digits a double has
double number_or(const Json& json, const char* name, double fallback);
std::optional<double> maybe_number(const Json& json, const char* name);
int integer_of(const Json& json, const char* name);
int integer_or(const Json& json, const char* name, int fallback);
bool flag_of(const Json& json, const char* name);  // false if not there
std::string string_of(const Json& json, const char* name);
std::string string_or(const Json& json, const char* name, const std::string& fallback);
std::vector<double> numbers_of(const Json& json, const char* name);  // empty if not there
std::vector<std::string> strings_of(const Json& json, const char* name);

}  // namespace rholm::studio
