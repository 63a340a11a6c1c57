#include "io/spill/piece_file.h"

#include <cstring>
#include <string_view>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/crc32.h"
#include "base/refuse.h"
#include "io/file/scalar_bytes.h"

namespace rholm {
namespace {

constexpr std::string_view kMark = "RHOLMPCE";
constexpr std::string_view kEnd = "PEND";
constexpr std::uint32_t kVersion = 2;

std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::uint64_t hash_of(std::span<const std::byte> bytes) {
  return XXH3_64bits(bytes.data(), bytes.size());
}

template <class T>
void store(std::byte* to, T value) {
  store_little_endian(reinterpret_cast<char*>(to), value);
}
template <class T>
T load_from(const std::byte* from) {
  return load<T, std::endian::native == std::endian::big>(reinterpret_cast<const char*>(from));
}

[[noreturn]] void refuse_piece(const std::string& name, const char* what) {
  refuse(name + ": " + what + "; delete it and begin that run anew");
}

}  // namespace

std::array<std::byte, kPieceHead> piece_head() {
  std::array<std::byte, kPieceHead> head = {};
  std::memcpy(head.data(), kMark.data(), kMark.size());
  store(head.data() + kMark.size(), kVersion);
  return head;
}

std::vector<std::byte> piece_tail(std::span<const PieceSection> sections) {
  std::vector<std::byte> tail(sections.size() * kPieceEntry + kPieceEnd);
  std::byte* to = tail.data();
  for (const PieceSection& section : sections) {
    store(to, section.size);
    store(to + 8, section.hash);
    to += kPieceEntry;
  }
  store(to, std::uint64_t{sections.size()});
  const auto counted = static_cast<std::size_t>(to + 8 - tail.data());
  store(to + 8, hash_of(std::span(tail).first(counted)));
  std::memcpy(to + 16, kEnd.data(), kEnd.size());
  return tail;
}

PieceSection section_of(std::span<const std::byte> bytes) {
  return {.size = bytes.size(), .hash = hash_of(bytes)};
}

std::vector<PieceSection> parse_piece(std::uint64_t size, const std::string& name,
                                      const ReadAt& read) {
  std::array<std::byte, kPieceHead> head;
  std::array<std::byte, kPieceEnd> end;
  if (size < kPieceHead + kPieceEnd || !read(0, head) || !read(size - kPieceEnd, end)) {
    refuse_piece(name, "is no whole piece of a run");
  }
  if (!text_of(head).starts_with(kMark)) refuse_piece(name, "is no piece of a run");
  if (head != piece_head()) refuse_piece(name, "is a piece of another version");
  if (!text_of(end).ends_with(kEnd)) refuse_piece(name, "is not whole");
  const auto n = load_from<std::uint64_t>(end.data());
  if (n > (size - kPieceHead - kPieceEnd) / kPieceEntry) refuse_piece(name, "is damaged");
  std::vector<std::byte> table(n * kPieceEntry + 8);
  const std::uint64_t at = size - kPieceEnd - n * kPieceEntry;
  if (!read(at, table)) refuse_piece(name, "is not whole");
  if (!kAnyChecksum && hash_of(table) != load_from<std::uint64_t>(end.data() + 8)) {
    refuse_piece(name, "is damaged");
  }
  std::vector<PieceSection> sections(n);
  std::uint64_t left = at - kPieceHead;
  for (std::size_t i = 0; i < n; ++i) {
    const std::byte* const from = table.data() + i * kPieceEntry;
    sections[i] = {load_from<std::uint64_t>(from), load_from<std::uint64_t>(from + 8)};
    if (sections[i].size > left) refuse_piece(name, "is damaged");
    left -= sections[i].size;
  }
  if (left != 0) refuse_piece(name, "is damaged");
  return sections;
}

void check_section(const PieceSection& section, std::span<const std::byte> bytes,
                   const std::string& name) {
  const bool right =
      section.size == bytes.size() && (kAnyChecksum || section.hash == hash_of(bytes));
  if (!right) refuse_piece(name, "is damaged");
}

}  // namespace rholm
