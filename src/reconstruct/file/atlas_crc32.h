// Checksums of arrays in a model file. Layer: reconstruct, private.
#pragma once

#include <bit>
#include <cstdint>

#include "base/crc32.h"
#include "reconstruct/file/atlas_pack.h"

namespace rholm {

// Returns the checksum of the bytes of several arrays, one after the other, as in the file.
template <typename... Arrays>
std::uint32_t crc32_of(const Arrays&... arrays) {
  static_assert(std::endian::native == std::endian::little, "the file is little endian");
  std::uint32_t sum = 0;
  const auto add = [&](const auto& values) {
    if (values.empty()) return;
    sum = crc32(
        {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values.front())},
        sum);
  };
  (add(arrays), ...);
  return sum;
}

// Returns the checksum of the datasets in the order caps, ellipses, weights, degrees, kept, values.
// HDF5 itself stores no checksum of them.
inline std::uint32_t atlas_crc32(const PackedAtlas& packed) {
  return crc32_of(packed.caps, packed.ellipses, packed.weights, packed.degrees, packed.kept,
                  packed.values);
}

}  // namespace rholm
