// JSON of results, from their fields. Layer: cli.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "cli/terminal/json.h"
#include "rholm/context.h"
#include "rholm/fields.h"

namespace rholm::cli {

template <HasFields T>
Json json_of_fields(const T& result);

// Converts a value of any type that a field may have.
template <typename V>
Json json_of_value(const V& value) {
  if constexpr (kIsOptional<V>) {
    return value ? json_of_value(*value) : Json(nullptr);
  } else if constexpr (std::is_same_v<V, Vec3>) {
    return json_of(value);
  } else if constexpr (HasFields<V>) {
    return json_of_fields(value);
  } else if constexpr (NamedEnum<V>) {
    return to_string(value);
  } else if constexpr (std::is_same_v<V, StageTimes>) {
    Json json = Json::object();
    for (const auto& [stage, time] : value) json[stage] = {{"wall", time.wall}, {"cpu", time.cpu}};
    return json;
  } else if constexpr (std::is_floating_point_v<V>) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
  } else if constexpr (requires { typename V::value_type; } && !std::is_same_v<V, std::string>) {
    Json list = Json::array();
    for (const auto& one : value) list.push_back(json_of_value(one));
    return list;
  } else {
    return value;
  }
}

// Returns {"field": value, ...} in the order of the list.
template <HasFields T>
Json json_of_fields(const T& result) {
  Json json = Json::object();
  for_each_field<T>(
      [&](auto member, const FieldInfo& info) { json[info.name] = json_of_value(result.*member); });
  return json;
}

}  // namespace rholm::cli
