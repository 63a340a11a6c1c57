// The checksum of an atlas in a model file. Layer: model, private.
#pragma once

#include <bit>
#include <string_view>
#include <vector>

#include "base/crc32.h"
#include "model/file/atlas_pack.h"

namespace rholm {

// Over the bytes of the datasets as they stand in the file, in the order caps, ellipses, weights,
// degrees, kept, values: what HDF5 itself leaves without a checksum.
inline std::uint32_t atlas_crc32(const PackedAtlas& packed) {
  static_assert(std::endian::native == std::endian::little, "the file is little endian");
  std::uint32_t sum = 0;
  const auto add = [&](const auto& values) {
    if (values.empty()) return;
    sum = crc32(
        {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values.front())},
        sum);
  };
  add(packed.caps), add(packed.ellipses), add(packed.weights);
  add(packed.degrees), add(packed.kept), add(packed.values);
  return sum;
}

}  // namespace rholm
