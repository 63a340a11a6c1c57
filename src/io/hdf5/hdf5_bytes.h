// Little-endian bytes of an HDF5 file, every access checked. Layer: io, private.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rholm::hdf5 {

struct File {
  std::string_view bytes;
  std::string name;  // for messages
  std::uint64_t root = 0;
};

constexpr std::uint64_t kUndefined = ~std::uint64_t{0};  // address of a missing object

[[noreturn]] void damaged(const File& file, const std::string& what);      // throws InvalidInput
[[noreturn]] void unsupported(const File& file, const std::string& what);  // throws Unsupported

// Reads a block from its beginning. Throws InvalidInput at the end of the block.
class ByteReader {
 public:
  ByteReader(const File& file, std::string_view block) : file_(file), block_(block) {}

  std::string_view take(std::uint64_t size);
  std::uint64_t number(std::size_t size);  // reads 1 to 8 bytes
  std::uint8_t u8() { return static_cast<std::uint8_t>(number(1)); }
  std::uint16_t u16() { return static_cast<std::uint16_t>(number(2)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(number(4)); }
  std::uint64_t u64() { return number(8); }
  void skip(std::uint64_t size) { take(size); }
  void expect(std::string_view signature);
  std::size_t left() const { return block_.size() - at_; }
  std::string_view passed() const { return block_.substr(0, at_); }

 private:
  const File& file_;
  std::string_view block_;
  std::size_t at_ = 0;
};

// Return the bytes from `address` on, or `size` of them; InvalidInput if the file is too short.
std::string_view bytes_from(const File& file, std::uint64_t address);
std::string_view bytes_at(const File& file, std::uint64_t address, std::uint64_t size);

// Bob Jenkins' lookup3 (public domain), the checksum of HDF5's metadata.
std::uint32_t lookup3(std::string_view bytes);

}  // namespace rholm::hdf5
