#include "studio/items/fields.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "studio/items/message.h"

namespace rholm::studio {
namespace {

// Returns nullptr if the field is missing or null.
const Json* find(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found == json.end() || found->is_null() ? nullptr : &*found;
}

const Json& need(const Json& json, const char* name) {
  if (const Json* field = find(json, name)) return *field;
  throw bad_request(fmt::format("the field '{}' is missing", name));
}

[[noreturn]] void refuse(const char* name, const char* wanted) {
  throw bad_request(fmt::format("the field '{}' must be {}", name, wanted));
}

double number(const Json& field, const char* name) {
  if (!field.is_number()) refuse(name, "a number");
  const double value = field.get<double>();
  if (!std::isfinite(value)) refuse(name, "finite");
  return value;
}

int integer(const Json& field, const char* name) {
  const double value = number(field, name);
  if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max()) {
    refuse(name, "a whole number");
  }
  return static_cast<int>(value);
}

std::string text(const Json& field, const char* name) {
  if (!field.is_string()) refuse(name, "a text");
  return field.get<std::string>();
}

}  // namespace

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json parse_object(std::string_view text) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) throw bad_request("the body is no JSON object");
  return json;
}

bool has_field(const Json& json, const char* name) { return find(json, name) != nullptr; }

double number_of(const Json& json, const char* name) { return number(need(json, name), name); }

double whole_number_of(const Json& json, const char* name) {
  const double value = number_of(json, name);
  if (value != std::floor(value) || std::abs(value) > 0x1p53) refuse(name, "a whole number");
  return value;
}

double number_or(const Json& json, const char* name, double fallback) {
  return maybe_number(json, name).value_or(fallback);
}

std::optional<double> maybe_number(const Json& json, const char* name) {
  const Json* field = find(json, name);
  return field == nullptr ? std::nullopt : std::optional<double>(number(*field, name));
}

int integer_of(const Json& json, const char* name) { return integer(need(json, name), name); }

int integer_or(const Json& json, const char* name, int fallback) {
  const Json* field = find(json, name);
  return field == nullptr ? fallback : integer(*field, name);
}

bool flag_of(const Json& json, const char* name) {
  const Json* field = find(json, name);
  if (field == nullptr) return false;
  if (!field->is_boolean()) refuse(name, "true or false");
  return field->get<bool>();
}

std::string string_of(const Json& json, const char* name) { return text(need(json, name), name); }

std::string string_or(const Json& json, const char* name, const std::string& fallback) {
  const Json* field = find(json, name);
  return field == nullptr ? fallback : text(*field, name);
}

std::vector<double> numbers_of(const Json& json, const char* name) {
  const Json* field = find(json, name);
  if (field == nullptr) return {};
  if (!field->is_array()) refuse(name, "a list of numbers");
  std::vector<double> values;
  values.reserve(field->size());
  for (const Json& value : *field) values.push_back(number(value, name));
  return values;
}

std::vector<std::string> strings_of(const Json& json, const char* name) {
  const Json* field = find(json, name);
  if (field == nullptr) return {};
  if (!field->is_array()) refuse(name, "a list of texts");
  std::vector<std::string> values;
  for (const Json& value : *field) values.push_back(text(value, name));
  return values;
}

}  // namespace rholm::studio
