#include <cstring>

#include "io/spill/piece_file.h"
#include "rholm/error.h"

// Checks that an Error is thrown, or that head, sections, table and end fill the file exactly.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto read = [&](std::uint64_t at, std::span<std::byte> bytes) {
    if (at > size || size - at < bytes.size()) return false;
    if (!bytes.empty()) std::memcpy(bytes.data(), data + at, bytes.size());
    return true;
  };
  try {
    const std::vector<rholm::PieceSection> sections = rholm::parse_piece(size, "fuzz", read);
    std::uint64_t at = rholm::kPieceHead;
    for (const rholm::PieceSection& section : sections) {
      if (section.size > size - at) __builtin_trap();
      std::vector<std::byte> bytes(section.size);
      if (!read(at, bytes)) __builtin_trap();
      rholm::check_section(section, bytes, "fuzz");
      at += section.size;
    }
    const std::size_t around = sections.size() * rholm::kPieceEntry + rholm::kPieceEnd;
    if (at + around != size) __builtin_trap();
  } catch (const rholm::Error&) {
    return 0;
  }
  return 0;
}
