#include "cli/files/memory_needed.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
#include <vector>

#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/grammar/values.h"
#include "rholm/mesh.h"

namespace rholm::cli {
namespace {

constexpr std::size_t kSample = std::size_t{1} << 18;  // chosen: thousands of lines

std::vector<char> bytes_at(std::ifstream& file, std::uintmax_t at, std::size_t size) {
  std::vector<char> bytes(size);
  file.clear();
  file.seekg(static_cast<std::streamoff>(at));
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

struct Words {
  std::size_t bytes = 0, words = 0;
  bool text = true;

  void add(std::span<const char> some) {
    bytes += some.size();
    bool inside = false;
    for (const char c : some) {
      const bool blank = c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',' || c == ';';
      words += !blank && !inside;
      inside = !blank;
      text = text && c != '\0';
    }
  }
};

// Bytes of a property of a binary PLY.
std::size_t size_of_type(std::string_view type) {
  for (const char* eight : {"double", "float64"}) {
    if (type == eight) return 8;
  }
  for (const char* two : {"short", "ushort", "int16", "uint16"}) {
    if (type == two) return 2;
  }
  for (const char* one : {"char", "uchar", "int8", "uint8"}) {
    if (type == one) return 1;
  }
  return 4;
}

// Of a binary PLY, by its header: coordinates and attributes of vertices become doubles, what
// follows is faces, of which a square (17 bytes) becomes two triangles (24). None for other files.
std::optional<double> memory_to_read_ply(const std::string& head, double bytes) {
  if (!head.starts_with("ply") || head.find("\nformat binary") == std::string::npos) return {};
  std::istringstream lines(head.substr(0, head.find("end_header")));
  double n_vertices = 0, row = 0, values = 0;
  bool in_vertices = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "element") {
      in_vertices = second == "vertex";
      if (in_vertices) n_vertices = read_number(third).value_or(0);
    } else if (first == "property" && in_vertices) {
      row += static_cast<double>(size_of_type(second));
      values += sizeof(double);
    }
  }
  constexpr double kFaces = 24.0 / 17;
  return bytes + n_vertices * values + kFaces * std::max(0.0, bytes - n_vertices * row);
}

}  // namespace

double memory_to_read(const std::string& path) {
  if (is_stream(path)) return 0;
  const auto size = file_size_of(path).value_or(0);
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> head = bytes_at(file, 0, kSample);
  const auto bytes = static_cast<double>(size);
  if (const auto ply = memory_to_read_ply({head.begin(), head.end()}, bytes)) return *ply;
  Words seen;
  seen.add(head);
  if (size > 3 * kSample) {
    seen.add(bytes_at(file, size / 2, kSample));
    seen.add(bytes_at(file, size - kSample, kSample));
  }
  constexpr double kFacet = 50;  // bytes of binary STL: three corners and their triangle
  if (!seen.text) return bytes * (1 + (3 * sizeof(Vec3) + sizeof(Triangle)) / kFacet);
  // A word is a double at most. While an array grows it is there twice, the new one with room for
  // as much again; 1.2 for lines that the samples have not seen.
  const double words = bytes * static_cast<double>(seen.words) /
                       static_cast<double>(std::max<std::size_t>(seen.bytes, 1));
  return bytes + 1.2 * 3 * sizeof(double) * words;
}

void require_to_read(const std::string& path, const MemoryOptions& memory) {
  if (!memory.gib || is_stream(path) || !is_shape(path).value_or(true)) return;
  memory.require(memory_to_read(path), "reading " + display_name(path));
}

}  // namespace rholm::cli
