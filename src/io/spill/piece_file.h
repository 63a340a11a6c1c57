// The file of a piece. Layer: io, private.
//
// "RHOLMPCE", the version (4 bytes) and four zeros; the bytes of all sections, one behind the
// other; of each section its number of bytes (8) and their XXH3 of 64 bits (8); the number of
// sections (8), the XXH3 of that table and that number (8), "PEND". All little endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "io/spill/spill_file.h"

namespace rholm {

struct PieceSection {
  std::uint64_t size = 0;
  std::uint64_t hash = 0;
};

inline constexpr std::size_t kPieceHead = 16;
inline constexpr std::size_t kPieceEntry = 16;  // of the table
inline constexpr std::size_t kPieceEnd = 20;    // behind it

std::array<std::byte, kPieceHead> piece_head();
std::vector<std::byte> piece_tail(std::span<const PieceSection> sections);
PieceSection section_of(std::span<const std::byte> bytes);

// The sections of a file of so many bytes; read(at, bytes) is false where it ends before. Throws
// InvalidInput (`name` is the file) for what is not whole, damaged, or no piece.
using ReadAt = std::function<bool(std::uint64_t at, std::span<std::byte> bytes)>;
std::vector<PieceSection> parse_piece(std::uint64_t size, const std::string& name,
                                      const ReadAt& read);

// Throws InvalidInput unless these are the bytes of the section.
void check_section(const PieceSection& section, std::span<const std::byte> bytes,
                   const std::string& name);

}  // namespace rholm
