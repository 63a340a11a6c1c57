#include "io/hdf5/hdf5_bytes.h"

#include <bit>

#include "rholm/error.h"

namespace rholm::hdf5 {

void damaged(const File& file, const std::string& what) {
  throw Error(ErrorCode::kInvalidInput, file.name + ": the HDF5 file is damaged: " + what);
}

void unsupported(const File& file, const std::string& what) {
  throw Error(ErrorCode::kUnsupported, file.name + ": " + what);
}

std::string_view ByteReader::take(std::uint64_t size) {
  if (size > left()) damaged(file_, "a block ends too early");
  const std::string_view taken = block_.substr(at_, size);
  at_ += size;
  return taken;
}

std::uint64_t ByteReader::number(std::size_t size) {
  const std::string_view bytes = take(size);
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < size; ++i) {
    value |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  }
  return value;
}

void ByteReader::expect(std::string_view signature) {
  if (take(signature.size()) != signature) {
    damaged(file_, "no '" + std::string(signature) + "' where it must be");
  }
}

std::string_view bytes_from(const File& file, std::uint64_t address) {
  if (address > file.bytes.size()) {
    damaged(file, "the address " + std::to_string(address) + " is behind its end");
  }
  return file.bytes.substr(address);
}

std::string_view bytes_at(const File& file, std::uint64_t address, std::uint64_t size) {
  const std::string_view bytes = bytes_from(file, address);
  if (size > bytes.size()) {
    damaged(file, std::to_string(size) + " bytes at " + std::to_string(address) +
                      " reach behind its end");
  }
  return bytes.substr(0, size);
}

std::uint32_t lookup3(std::string_view bytes) {
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4 && at + i < bytes.size(); ++i) {
      value |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
    }
    return value;
  };
  std::uint32_t a = 0xdeadbeef + static_cast<std::uint32_t>(bytes.size());
  std::uint32_t b = a, c = a;
  std::size_t at = 0;
  for (; bytes.size() - at > 12; at += 12) {
    a += word(at), b += word(at + 4), c += word(at + 8);
    a -= c, a ^= std::rotl(c, 4), c += b;
    b -= a, b ^= std::rotl(a, 6), a += c;
    c -= b, c ^= std::rotl(b, 8), b += a;
    a -= c, a ^= std::rotl(c, 16), c += b;
    b -= a, b ^= std::rotl(a, 19), a += c;
    c -= b, c ^= std::rotl(b, 4), b += a;
  }
  if (at == bytes.size()) return c;
  a += word(at), b += word(at + 4), c += word(at + 8);
  c ^= b, c -= std::rotl(b, 14);
  a ^= c, a -= std::rotl(c, 11);
  b ^= a, b -= std::rotl(a, 25);
  c ^= b, c -= std::rotl(b, 16);
  a ^= c, a -= std::rotl(c, 4);
  b ^= a, b -= std::rotl(a, 14);
  c ^= b, c -= std::rotl(b, 24);
  return c;
}

}  // namespace rholm::hdf5
