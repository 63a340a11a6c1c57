// STL: facets, each with its own three vertices, which are not joined here.
// Source: 3D Systems, StereoLithography Interface Specification (1989).
#include <algorithm>
#include <array>
#include <limits>

#include "io/file/number_text.h"
#include "io/file/scalar_bytes.h"
#include "io/shapes/shape_source.h"

namespace rholm {
namespace {

constexpr std::size_t kHeader = 80;          // free text
constexpr std::size_t kCount = kHeader + 4;  // ... and the number of facets
constexpr std::size_t kFacet = 12 * 4 + 2;   // normal, three vertices, two unspecified bytes
constexpr bool kSwap = std::endian::native == std::endian::big;

std::uint64_t claimed_facets(std::span<const char> bytes) {
  return load<std::uint32_t, kSwap>(bytes.data() + kHeader);
}

// Returns the number of facets that fit into a binary file of this size.
std::uint64_t facets_with_room(std::span<const char> bytes) {
  return (bytes.size() - kCount) / kFacet;
}

// Some programs write facets as they come and never store their count.
bool is_uncounted(std::span<const char> bytes) {
  const std::uint64_t n = claimed_facets(bytes);
  return n == 0 || n == std::numeric_limits<std::uint32_t>::max();
}

// Some programs write binary files that begin with "solid", so the size decides.
bool is_binary_by_size(std::span<const char> bytes) {
  return bytes.size() >= kCount && bytes.size() == kCount + kFacet * claimed_facets(bytes);
}

bool equal_ignoring_case(std::string_view word, std::string_view lower) {
  return word.size() == lower.size() &&
         std::equal(word.begin(), word.end(), lower.begin(), [](char a, char b) {
           return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
         });
}

bool begins_with_solid(std::span<const char> bytes) {
  TextCursor text(bytes);
  skip_spaces(text);
  return equal_ignoring_case(take_word(text), "solid");
}

// Text has a keyword after the line with the name; a binary count never looks like one.
bool is_text(std::span<const char> bytes) {
  if (!begins_with_solid(bytes)) return false;
  TextCursor text(bytes);
  skip_spaces(text);
  skip_to_line_end(text);
  skip_spaces(text);
  const std::string_view word = take_word(text);
  return equal_ignoring_case(word, "facet") || equal_ignoring_case(word, "endsolid");
}

// Returns true for a binary file with complete facets and data after them.
bool may_be_binary(std::span<const char> bytes) {
  if (bytes.size() < kCount + kFacet) return false;
  return is_uncounted(bytes) || claimed_facets(bytes) <= facets_with_room(bytes);
}

// Makes a mesh whose facets each have three vertices of their own: 0 1 2, 3 4 5, ...
Mesh soup(std::vector<Vec3> vertices) {
  Mesh mesh;
  mesh.faces.reserve(vertices.size() / 3);
  for (std::uint32_t i = 0; i + 2 < vertices.size(); i += 3) {
    mesh.faces.push_back({i, i + 1, i + 2});
  }
  mesh.vertices = std::move(vertices);
  return mesh;
}

constexpr std::uint64_t kMaxFacets = std::numeric_limits<std::uint32_t>::max() / 3;

// Returns the number of facets to read, and warns if the file states another number.
std::uint64_t facets_of(const ShapeSource& source, std::vector<std::string>& warnings) {
  const std::uint64_t n = claimed_facets(source.bytes), room = facets_with_room(source.bytes);
  if (is_uncounted(source.bytes) && room > 0) {
    warnings.push_back("the count of facets is " + std::to_string(n) + ", but " +
                       counted(room, "facet follows", "facets follow") + ": they are read");
    const std::uint64_t rest = source.bytes.size() - kCount - kFacet * room;
    if (rest > 0)
      warnings.push_back(counted(rest, "byte", "bytes") + " behind the last facet passed over");
    return room;
  }
  if (n > room) {
    source.fail("truncated: its count of facets is " + std::to_string(n) +
                ", for which a binary STL file has " + std::to_string(kCount + kFacet * n) +
                " bytes; this one has " + std::to_string(source.bytes.size()) + ", room for " +
                counted(room, "facet", "facets"));
  }
  const std::uint64_t rest = source.bytes.size() - kCount - kFacet * n;
  if (rest > 0) {
    warnings.push_back(
        counted(rest, "byte", "bytes") + " behind the last of " + counted(n, "facet", "facets") +
        " passed over" +
        (rest >= kFacet
             ? ": room for " + counted(rest / kFacet, "more that the count does not name",
                                       "more, which the count does not name")
             : ""));
  }
  return n;
}

Mesh read_binary(const ShapeSource& source, std::vector<std::string>& warnings) {
  const std::span<const char> bytes = source.bytes;
  if (bytes.size() < kCount) {
    source.fail("truncated: a binary STL file has at least 84 bytes, this one has " +
                std::to_string(bytes.size()));
  }
  const std::uint64_t n = facets_of(source, warnings);
  if (n == 0) source.fail("has no facets");
  if (n > kMaxFacets) {
    source.fail("has " + std::to_string(n) + " facets, the limit is " + std::to_string(kMaxFacets));
  }
  std::vector<Vec3> vertices;
  vertices.reserve(3 * n);
  std::array<Vec3, 3 * 256> block;  // 18 kB, stays in the first-level cache
  const char* at = bytes.data() + kCount;
  for (std::uint64_t facet = 0; facet < n;) {
    const std::size_t rows = std::min<std::uint64_t>(block.size() / 3, n - facet);
    for (std::size_t i = 0; i < 3 * rows; ++i) {
      const char* p = at + (i / 3) * kFacet + 12 + (i % 3) * 12;
      block[i] = {load<float, kSwap>(p), load<float, kSwap>(p + 4), load<float, kSwap>(p + 8)};
    }
    const std::span<const Vec3> corners = std::span(block).first(3 * rows);
    check_finite(source, corners, vertices.size(), "facet corner", "coordinate");
    vertices.insert(vertices.end(), corners.begin(), corners.end());
    at += rows * kFacet;
    facet += rows;
    source.progress(at);
  }
  return soup(std::move(vertices));
}

class StlTextReader {
 public:
  explicit StlTextReader(const ShapeSource& source) : source_(source), text_(source.bytes) {}

  Mesh read(std::vector<std::string>& warnings) {
    // "facet outer loop vertex 0 0 0 ..." has at least 80 bytes.
    vertices_.reserve(3 * (source_.bytes.size() / 256));
    std::size_t solids = 0;
    for (skip_spaces(text_); !text_.at_end(); skip_spaces(text_)) {
      if (solids > 0 && is_rest()) {
        warnings.push_back(
            counted(static_cast<std::size_t>(text_.end - text_.at), "byte", "bytes") +
            " behind the last 'endsolid' passed over");
        break;
      }
      expect("solid");
      skip_to_line_end(text_);  // its name
      read_facets();
      ++solids;
    }
    if (vertices_.empty()) source_.fail("has no facets");
    if (solids > 1) warnings.push_back(std::to_string(solids) + " solids read as one mesh");
    return soup(std::move(vertices_));
  }

 private:
  // Returns true if the remaining text has neither a solid nor facets.
  bool is_rest() const {
    for (TextCursor rest = text_; !rest.at_end(); skip_spaces(rest)) {
      const std::string_view word = take_word(rest);
      if (equal_ignoring_case(word, "solid") || equal_ignoring_case(word, "facet")) return false;
    }
    return true;
  }

  void read_facets() {
    for (;;) {
      const TextCursor before = skip_to_next();
      const std::string_view word = take_word(text_);
      if (equal_ignoring_case(word, "facet")) {
        read_facet();
      } else if (equal_ignoring_case(word, "endsolid")) {
        return skip_to_line_end(text_);
      } else {
        text_ = before;
        fail_line(quoted_word(text_) + " where 'facet' or 'endsolid' was expected");
      }
    }
  }

  // The normal is not needed because it follows from the vertices; it may be missing or nan.
  void read_facet() {
    if (vertices_.size() / 3 == kMaxFacets) fail_line("too many facets");
    expect("normal");
    for (int i = 0;; ++i) {
      const TextCursor before = skip_to_next();
      if (equal_ignoring_case(take_word(text_), "outer")) break;
      if (i < 3) continue;
      text_ = before;
      fail_line(quoted_word(text_) + " where 'outer' was expected");
    }
    expect("loop");
    for (int k = 0; k < 3; ++k) {
      expect("vertex");
      const double x = take_coordinate();
      const double y = take_coordinate();
      vertices_.push_back({x, y, take_coordinate()});
    }
    expect("endloop");
    expect("endfacet");
    source_.progress(text_.at);
  }

  TextCursor skip_to_next() {
    skip_spaces(text_);
    if (text_.at_end()) {
      source_.fail("truncated: the file ends before 'endsolid', after " +
                   counted(vertices_.size() / 3, "facet", "facets"));
    }
    return text_;
  }

  void expect(const char* keyword) {
    const TextCursor before = skip_to_next();
    if (equal_ignoring_case(take_word(text_), keyword)) return;
    text_ = before;
    fail_line(quoted_word(text_) + " where '" + keyword + "' was expected");
  }

  double take_coordinate() {
    const TextCursor before = skip_to_next();
    double value = 0;
    if (take_number(text_, value) && at_word_end(text_) && std::isfinite(value)) return value;
    text_ = before;
    fail_line(quoted_word(text_) + " is not a finite number");
  }

  [[noreturn]] void fail_line(const std::string& what) const {
    fail_at_line(source_.name, text_, what);
  }

  const ShapeSource& source_;
  TextCursor text_;
  std::vector<Vec3> vertices_;
};

}  // namespace

ShapeFile read_stl(const ShapeSource& source) {
  ShapeFile file;
  file.format = ShapeFormat::kStl;
  const bool binary =
      is_binary_by_size(source.bytes) || (!is_text(source.bytes) && may_be_binary(source.bytes));
  if (!binary && begins_with_solid(source.bytes)) {
    file.encoding = "ascii";
    file.shape = StlTextReader(source).read(file.warnings);
  } else {
    file.encoding = "binary little endian";
    file.shape = read_binary(source, file.warnings);
  }
  return file;
}

bool looks_like_stl(std::span<const char> bytes) {
  return is_binary_by_size(bytes) || is_text(bytes);
}

bool may_be_stl(std::span<const char> bytes) { return may_be_binary(bytes); }

}  // namespace rholm
