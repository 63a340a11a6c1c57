// Checks options against the bounds of their fields. Layer: base, private.
#pragma once

#include <type_traits>

#include "rholm/fields.h"
#include "rholm/vec3.h"

namespace rholm {

// Throws InvalidInput with name, value and limits if a number is NaN or out of its bounds.
void check_number(const FieldInfo& info, double value);

template <HasFields Options>
void check_fields(const Options& options);

template <typename V>
void check_field(const FieldInfo& info, const V& value) {
  if constexpr (kIsOptional<V>) {
    if (value) check_field(info, *value);
  } else if constexpr (HasFields<V>) {
    check_fields(value);
  } else if constexpr (std::is_same_v<V, Vec3>) {
    for (const double c : {value.x, value.y, value.z}) check_number(info, c);
  } else if constexpr (Number<V>) {
    check_number(info, static_cast<double>(value));
  }
}

// Throws InvalidInput for the first value that is out of its bounds.
template <HasFields Options>
void check_fields(const Options& options) {
  for_each_field<Options>(
      [&](auto member, const FieldInfo& info) { check_field(info, options.*member); });
}

}  // namespace rholm
