// CRC-32 as in zlib, PNG and Python's zlib.crc32. Layer: base, private.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace rholm {

// True where wrong checksums are to be passed over: a fuzzer does not find right ones.
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
inline constexpr bool kAnyChecksum = true;
#else
inline constexpr bool kAnyChecksum = false;
#endif

// Of `bytes`, continuing `before`, the value of what stands before them.
inline std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0) {
  static constexpr auto kTable = [] {
    std::array<std::uint32_t, 256> table = {};
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t value = byte;
      // The polynomial of IEEE 802.3, bits reversed.
      for (int bit = 0; bit < 8; ++bit) value = value >> 1 ^ ((value & 1) != 0 ? 0xedb88320U : 0);
      table[byte] = value;
    }
    return table;
  }();
  std::uint32_t value = ~before;
  for (const char c : bytes)
    value = value >> 8 ^ kTable[(value ^ static_cast<unsigned char>(c)) & 0xff];
  return ~value;
}

}  // namespace rholm
