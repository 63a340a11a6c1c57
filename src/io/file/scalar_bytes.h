// Scalars of any type in either byte order, at any address. Layer: io.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "rholm/mesh.h"

namespace rholm {

// Smallest double that rounds to an infinite float: halfway between the largest float and 2^128.
inline constexpr double kInfiniteAsFloat = 0x1.ffffffp127;

template <std::size_t kSize>
using UnsignedOf = std::conditional_t<
    kSize == 1, std::uint8_t,
    std::conditional_t<kSize == 2, std::uint16_t,
                       std::conditional_t<kSize == 4, std::uint32_t, std::uint64_t>>>;

template <class Unsigned>
constexpr Unsigned reversed_bytes(Unsigned value) {
  if constexpr (sizeof(Unsigned) == 2) return __builtin_bswap16(value);
  if constexpr (sizeof(Unsigned) == 4) return __builtin_bswap32(value);
  if constexpr (sizeof(Unsigned) == 8) return __builtin_bswap64(value);
  return value;
}

template <class T, bool kSwap>
T load(const char* from) {
  UnsignedOf<sizeof(T)> bits;
  std::memcpy(&bits, from, sizeof(T));
  if constexpr (kSwap) bits = reversed_bytes(bits);
  return std::bit_cast<T>(bits);
}

// Stores the bytes of `value`, little endian.
template <class T>
void store_little_endian(char* to, T value) {
  auto bits = std::bit_cast<UnsignedOf<sizeof(T)>>(value);
  if constexpr (std::endian::native == std::endian::big) bits = reversed_bytes(bits);
  std::memcpy(to, &bits, sizeof(T));
}

// Calls function(std::type_identity<T>()) with the C++ type T of `type`.
template <class Function>
decltype(auto) with_scalar_type(ScalarType type, Function&& function) {
  switch (type) {
    case ScalarType::kInt8:
      return function(std::type_identity<std::int8_t>());
    case ScalarType::kUint8:
      return function(std::type_identity<std::uint8_t>());
    case ScalarType::kInt16:
      return function(std::type_identity<std::int16_t>());
    case ScalarType::kUint16:
      return function(std::type_identity<std::uint16_t>());
    case ScalarType::kInt32:
      return function(std::type_identity<std::int32_t>());
    case ScalarType::kUint32:
      return function(std::type_identity<std::uint32_t>());
    case ScalarType::kFloat32:
      return function(std::type_identity<float>());
    case ScalarType::kFloat64:
      break;
  }
  return function(std::type_identity<double>());
}

}  // namespace rholm
