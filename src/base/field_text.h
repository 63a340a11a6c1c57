// Writes options as text, which a folder to resume from stores. Layer: base, private.
#pragma once

#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "rholm/fields.h"
#include "rholm/vec3.h"

namespace rholm {

template <HasFields Options>
std::string text_of_fields(const Options& options);

// Returns different texts for different values: numbers have all their digits.
template <typename V>
std::string text_of_field(const V& value) {
  if constexpr (kIsOptional<V>) {
    return value ? text_of_field(*value) : "none";
  } else if constexpr (HasFields<V>) {
    return "(" + text_of_fields(value) + ")";
  } else if constexpr (NamedEnum<V>) {
    return to_string(value);
  } else if constexpr (std::is_same_v<V, std::filesystem::path>) {
    return value.string();
  } else if constexpr (std::is_same_v<V, Vec3>) {
    return fmt::format("{},{},{}", value.x, value.y, value.z);
  } else {
    return fmt::format("{}", value);
  }
}

// Returns "step 0 tolerance 0.1 holes fill ...", with all fields that change the result.
template <HasFields Options>
std::string text_of_fields(const Options& options) {
  std::string text;
  for_each_field<Options>([&](auto member, const FieldInfo& info) {
    if (!info.changes_result) return;
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : " ", info.name, text_of_field(options.*member));
  });
  return text;
}

}  // namespace rholm
