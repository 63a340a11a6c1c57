// Writes options and results as bytes for other processes, field by field. Layer: base, private.
#pragma once

#include <filesystem>
#include <string>

#include "base/bytes.h"
#include "rholm/fields.h"

namespace rholm {

template <HasFields Options>
void write_fields(const Options& options, ByteWriter& writer);
template <HasFields Options>
void read_fields(ByteReader& reader, Options& options);

template <typename V>
void write_field(const V& value, ByteWriter& writer) {
  if constexpr (kIsOptional<V>) {
    writer.value(value.has_value());
    if (value) write_field(*value, writer);
  } else if constexpr (HasFields<V>) {
    write_fields(value, writer);
  } else if constexpr (std::is_same_v<V, std::filesystem::path>) {
    writer.text(value.string());
  } else if constexpr (std::is_same_v<V, std::string>) {
    writer.text(value);
  } else {
    writer.value(value);
  }
}

template <typename V>
void read_field(ByteReader& reader, V& value) {
  if constexpr (kIsOptional<V>) {
    bool is_there = false;
    reader.value(is_there);
    value.reset();
    if (is_there) read_field(reader, value.emplace());
  } else if constexpr (HasFields<V>) {
    read_fields(reader, value);
  } else if constexpr (std::is_same_v<V, std::filesystem::path> || std::is_same_v<V, std::string>) {
    value = std::string(reader.text());
  } else {
    reader.value(value);
  }
}

template <HasFields Options>
void write_fields(const Options& options, ByteWriter& writer) {
  for_each_field<Options>(
      [&](auto member, const FieldInfo&) { write_field(options.*member, writer); });
}
template <HasFields Options>
void read_fields(ByteReader& reader, Options& options) {
  for_each_field<Options>(
      [&](auto member, const FieldInfo&) { read_field(reader, options.*member); });
}

}  // namespace rholm
