#include "cli/files/memory_needed.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/paths.h"
#include "cli/grammar/values.h"

namespace rholm::cli {
namespace {

// A megabyte is inspected, in samples all over the file: an OBJ file may have all faces at its end.
constexpr std::size_t kPieces = 256, kPiece = std::size_t{1} << 12;
// Factor for counting errors. Chosen: a sample is 0.4 % of a file, and only some samples contain
// the first or last lines of a kind.
constexpr double kCountError = 1.03;

std::string bytes_at(std::ifstream& file, std::uintmax_t at, std::size_t size) {
  std::string bytes(size, '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(at));
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

// Returns the words of a line, between blanks, commas and semicolons.
std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view kBetween = " \t\r,;";
  std::vector<std::string_view> words;
  for (;;) {
    const std::size_t first = line.find_first_not_of(kBetween);
    if (first == std::string_view::npos) return words;
    line.remove_prefix(first);
    const std::size_t n = std::min(line.find_first_of(kBetween), line.size());
    words.push_back(line.substr(0, n));  // NOLINT(performance-inefficient-vector-operation)
    line.remove_prefix(n);
  }
}

// Counts of lines of a text, by their first words.
struct Lines {
  double vertices = 0, vertex_values = 0;       // "v"; numbers after them
  double normals = 0, textures = 0;             // "vn", "vt"
  double faces = 0, polygons = 0, corners = 0;  // "f"; more than three corners; their corners
  double facet_corners = 0;                     // "vertex" of STL
  double rows = 0, values = 0;                  // other lines; words in them

  void add(std::string_view line, double weight) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty() || words[0][0] == '#') return;
    const auto others = static_cast<double>(words.size() - 1);
    if (words[0] == "v") {
      vertices += weight;
      vertex_values += weight * others;
    } else if (words[0] == "vn") {
      normals += weight;
    } else if (words[0] == "vt") {
      textures += weight;
    } else if (words[0] == "f") {
      faces += weight;
      if (others > 3) polygons += weight;
      if (others > 3) corners += weight * others;
    } else if (words[0] == "vertex") {
      facet_corners += weight;
    } else {
      rows += weight;
      values += weight * (others + 1);
    }
  }
};

// Counts lines of a whole file from samples. Returns nothing if the file is no text.
std::optional<Lines> lines_of(std::ifstream& file, std::uintmax_t size) {
  Lines lines;
  const bool whole = size <= kPieces * kPiece;
  const std::size_t pieces = whole ? 1 : kPieces;
  for (std::size_t i = 0; i < pieces; ++i) {
    const std::string piece =
        bytes_at(file, size / pieces * i, whole ? static_cast<std::size_t>(size) : kPiece);
    if (piece.find('\0') != std::string::npos) return {};
    std::string_view rest = piece;
    if (!whole) {  // count only lines whose first and last bytes are in the sample
      const std::size_t first = rest.find('\n'), last = rest.rfind('\n');
      if (first == last) continue;
      rest = rest.substr(first + 1, last - first);
    }
    const double weight = static_cast<double>(size) / static_cast<double>(pieces) /
                          std::max(static_cast<double>(rest.size()), 1.0);
    while (!rest.empty()) {
      const std::size_t n = std::min(rest.find('\n'), rest.size() - 1) + 1;
      lines.add(rest.substr(0, n - 1), weight);
      rest.remove_prefix(n);
    }
  }
  return lines;
}

// Returns the bytes of an array that grows to n elements by doubling, when old and new array
// coexist.
double grown(double n, double element) {
  if (n <= 0) return 0;
  const double room = std::exp2(std::ceil(std::log2(n)));
  return 1.5 * room * element;
}

// Polygons are stored with their corners until all vertices are known; then triangles are made.
double memory_of_polygons(double polygons, double corners) {
  constexpr double kPolygon = 16;
  return grown(polygons, kPolygon) + grown(corners, sizeof(std::uint32_t)) +
         (corners - 2 * polygons) * sizeof(Triangle);
}

// ---- Files whose headers have the counts: PLY, OFF ----

// Returns the bytes of a property of a binary PLY.
double size_of_type(std::string_view type) {
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

// Counts from a header.
struct Counts {
  double vertices = 0, faces = 0;
  double values = 0;  // per vertex
  double row = 0;     // bytes of a vertex in a binary file
  bool is_text = false;
};

std::optional<Counts> counts_of_ply(const std::string& head) {
  if (!head.starts_with("ply")) return {};
  Counts counts{.is_text = head.find("\nformat ascii") != std::string::npos};
  std::istringstream lines(head.substr(0, head.find("end_header")));
  bool in_vertices = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, second, third;
    words >> first >> second >> third;
    if (first == "element") {
      in_vertices = second == "vertex";
      const double n = read_number(third).value_or(0);
      if (in_vertices) counts.vertices = n;
      if (second == "face") counts.faces = n;
    } else if (first == "property" && in_vertices) {
      counts.row += size_of_type(second);
      counts.values += 1;
    }
  }
  return counts;
}

std::optional<Counts> counts_of_off(const std::string& head) {
  std::istringstream lines(head);
  std::string word;
  if (!(lines >> word) || !word.ends_with("OFF")) return {};
  Counts counts{.is_text = true};
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty() || words[0][0] == '#') continue;
    if (counts.vertices == 0) {
      counts.vertices = read_number(std::string(words[0])).value_or(0);
      counts.faces = words.size() > 1 ? read_number(std::string(words[1])).value_or(0) : 0;
      continue;
    }
    counts.values = static_cast<double>(words.size());
    break;
  }
  return counts;
}

// Returns the mean number of corners of the faces at the end of a text, at least three.
double corners_of_faces(std::ifstream& file, std::uintmax_t size) {
  const std::size_t some = static_cast<std::size_t>(std::min<std::uintmax_t>(size, 16 * kPiece));
  const std::string piece = bytes_at(file, size - some, some);
  std::istringstream lines(piece.substr(std::min(piece.find('\n'), piece.size())));
  double faces = 0, corners = 0;
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) continue;
    faces += 1;
    corners += std::max(3.0, read_number(std::string(words[0])).value_or(3));
  }
  return faces > 0 ? corners / faces : 3;
}

ShapeMemory memory_of_counts(const Counts& counts, std::ifstream& file, std::uintmax_t size) {
  const auto bytes = static_cast<double>(size);
  constexpr double kTriangle = 13, kSquare = 17, kOfSquare = 2;  // bytes, and triangles
  // The file's size limits the counts.
  const double vertices = std::min(counts.vertices, bytes / (counts.is_text ? 6 : 3));
  double faces = std::min(counts.faces, bytes / (counts.is_text ? 4 : 1));
  double polygons = 0;
  if (faces > 0 && counts.is_text) {
    const double corners = corners_of_faces(file, size);
    if (corners > 3) polygons = memory_of_polygons(faces, corners * faces);
    faces *= corners - 2;
  } else if (faces > 0) {
    const double face = std::max(0.0, bytes - vertices * counts.row) / faces;
    if (face > kTriangle + 1) {
      polygons = memory_of_polygons(faces, (face - 1) / sizeof(std::uint32_t) * faces);
      faces *= std::max(1.0, kOfSquare * face / kSquare);
    }
  }
  ShapeMemory memory{
      .vertices = vertices, .faces = faces, .attributes = std::max(0.0, counts.values - 3)};
  memory.reading = bytes + memory.kept() + polygons;
  return memory;
}

// ---- Files without counts ----

ShapeMemory memory_of_lines(const Lines& lines, double bytes) {
  if (lines.facet_corners > 0) {
    ShapeMemory memory{.vertices = kCountError * lines.facet_corners,
                       .faces = kCountError * lines.facet_corners / 3};
    // The reader reserves facets of 256 bytes, and grows if facets are shorter.
    const double room = 3 * bytes / 256;
    const double vertices = memory.vertices <= room ? room : 3 * room;
    memory.reading = bytes + std::max(vertices * sizeof(Vec3), memory.kept());
    return memory;
  }
  if (lines.vertices > 0) {
    const double n = kCountError * lines.vertices;
    ShapeMemory memory{.vertices = n,
                       .faces = kCountError * (lines.faces + lines.corners - 3 * lines.polygons)};
    // Colours, normals and texture coordinates are read separately, then become attributes of
    // vertices.
    double apart = 0;
    if (lines.vertex_values >= 6 * lines.vertices) {
      memory.attributes += 3;
      apart += sizeof(Vec3) * n;
    }
    const double place = sizeof(std::uint32_t) * n;
    if (lines.normals > 0) {
      memory.attributes += 3;
      apart += sizeof(Vec3) * (kCountError * lines.normals + n) + place;
    }
    if (lines.textures > 0) {
      memory.attributes += 2;
      apart += 2 * sizeof(double) * (kCountError * lines.textures + n) + place;
    }
    memory.reading = bytes + memory.kept() + apart +
                     memory_of_polygons(kCountError * lines.polygons, kCountError * lines.corners);
    return memory;
  }
  ShapeMemory memory{.vertices = kCountError * lines.rows,
                     .attributes = std::max(0.0, lines.values / std::max(lines.rows, 1.0) - 3)};
  memory.reading = bytes + grown(memory.vertices, memory.kept() / std::max(memory.vertices, 1.0));
  return memory;
}

}  // namespace

ShapeMemory memory_to_read(const std::string& path) {
  if (is_stream(path) || !is_shape(path).value_or(true)) return {};
  const auto size = file_size_of(path).value_or(0);
  std::ifstream file(path, std::ios::binary);
  const std::string head = bytes_at(file, 0, 16 * kPiece);
  if (const auto counts = counts_of_ply(head)) return memory_of_counts(*counts, file, size);
  if (const auto counts = counts_of_off(head)) return memory_of_counts(*counts, file, size);
  const auto bytes = static_cast<double>(size);
  if (const auto lines = lines_of(file, size)) return memory_of_lines(*lines, bytes);
  constexpr double kFacet = 50;  // bytes of binary STL
  ShapeMemory memory{.vertices = 3 * bytes / kFacet, .faces = bytes / kFacet};
  memory.reading = bytes + memory.kept();
  return memory;
}

void require_to_read(const std::string& path, const MemoryOptions& memory,
                     const MemoryOfMesh& work) {
  if (!memory.gib) return;
  const ShapeMemory shape = memory_to_read(path);
  memory.require(std::max(shape.reading, work.of(shape)), "reading " + display_name(path));
}

}  // namespace rholm::cli
