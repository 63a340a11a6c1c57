// Options as the bytes of a message, by their fields. Layer: cluster, private.
#pragma once

#include <filesystem>
#include <string>

#include "cluster/pack.h"
#include "rholm/fields.h"
#include "rholm/vec3.h"

namespace rholm {

template <HasFields Options>
void pack_fields(const Options& options, Packer& packer);
template <HasFields Options>
void unpack_fields(Unpacker& bytes, Options& options);

template <typename V>
void pack_value(const V& value, Packer& packer) {
  if constexpr (kIsOptional<V>) {
    packer.number(value ? 1 : 0);
    if (value) pack_value(*value, packer);
  } else if constexpr (HasFields<V>) {
    pack_fields(value, packer);
  } else if constexpr (std::is_same_v<V, Vec3>) {
    packer.real(value.x).real(value.y).real(value.z);
  } else if constexpr (std::is_floating_point_v<V>) {
    packer.real(value);
  } else if constexpr (std::is_same_v<V, std::filesystem::path>) {
    packer.text(value.string());
  } else if constexpr (std::is_same_v<V, std::string>) {
    packer.text(value);
  } else {
    static_assert(std::is_integral_v<V> || std::is_enum_v<V>);
    packer.number(static_cast<std::uint64_t>(value));
  }
}

template <typename V>
void unpack_value(Unpacker& bytes, V& value) {
  if constexpr (kIsOptional<V>) {
    value.reset();
    if (bytes.number() != 0) unpack_value(bytes, value.emplace());
  } else if constexpr (HasFields<V>) {
    unpack_fields(bytes, value);
  } else if constexpr (std::is_same_v<V, Vec3>) {
    for (double* c : {&value.x, &value.y, &value.z}) *c = bytes.real();
  } else if constexpr (std::is_floating_point_v<V>) {
    value = bytes.real();
  } else if constexpr (std::is_same_v<V, std::filesystem::path> || std::is_same_v<V, std::string>) {
    value = std::string(bytes.text());
  } else {
    value = static_cast<V>(bytes.number());
  }
}

template <HasFields Options>
void pack_fields(const Options& options, Packer& packer) {
  for_each_field<Options>(
      [&](auto member, const FieldInfo&) { pack_value(options.*member, packer); });
}
template <HasFields Options>
void unpack_fields(Unpacker& bytes, Options& options) {
  for_each_field<Options>(
      [&](auto member, const FieldInfo&) { unpack_value(bytes, options.*member); });
}

}  // namespace rholm
