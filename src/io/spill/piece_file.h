// The file of a piece. Layer: io, private.
//
// The file has "RHOLMPCE", the version (4 bytes), four zeros, and the bytes of all sections. A
// table follows with the number of bytes (8) and their 64-bit XXH3 (8) of each section. It ends
// with the number of sections (8), the XXH3 of table and number (8) and "PEND". All little endian.
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
inline constexpr std::size_t kPieceEntry = 16;  // bytes per section in the table
inline constexpr std::size_t kPieceEnd = 20;    // bytes after the table

std::array<std::byte, kPieceHead> piece_head();
std::vector<std::byte> piece_tail(std::span<const PieceSection> sections);
PieceSection section_of(std::span<const std::byte> bytes);

// Returns the sections of a file of `size` bytes; read(at, bytes) returns false at its end. Throws
// InvalidInput (`name` is the file) if it is incomplete, damaged or no piece.
using ReadAt = std::function<bool(std::uint64_t at, std::span<std::byte> bytes)>;
std::vector<PieceSection> parse_piece(std::uint64_t size, const std::string& name,
                                      const ReadAt& read);

// Throws InvalidInput unless the section has these bytes.
void check_section(const PieceSection& section, std::span<const std::byte> bytes,
                   const std::string& name);

}  // namespace rholm
