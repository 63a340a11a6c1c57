// OBJ: reads vertices, normals, texture coordinates and faces; ignores other statements.
// Source: Wavefront Advanced Visualizer manual, appendix B1, and the colours (v x y z r g b) and
// weights of later writers.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/cancel.h"
#include "io/file/number_text.h"
#include "io/shapes/face_list.h"
#include "io/shapes/shape_source.h"
#include "rholm/mesh.h"

namespace rholm {
namespace {

// Converts normals and texture coordinates of OBJ corners to values of vertices.

// The index of a normal, or of a texture coordinate, that the corners of faces give to each vertex.
// Used as long as no vertex has two different values.
class CornerData {
 public:
  // `values` are the values defined so far, with the numbering of `index`.
  template <class Value>
  void assign(std::uint32_t vertex, std::uint32_t index, std::size_t n_vertices,
              const std::vector<Value>& values) {
    if (vertex >= n_vertices) {
      ahead_.push_back({vertex, index});  // the face precedes its vertices
      return;
    }
    if (index_.size() <= vertex) index_.resize(n_vertices, kNone);
    if (index_[vertex] == kNone) {
      index_[vertex] = index;
    } else if (index_[vertex] != index) {
      const std::size_t last = std::max(index_[vertex], index);
      if (last >= values.size() || values[index_[vertex]] != values[index]) conflict_ = true;
    }
  }

  // Returns one value per vertex if every vertex of a triangle has one; other vertices get zeros.
  template <class Value>
  std::vector<Value> values_of(const Mesh& mesh, const std::vector<Value>& values) {
    const std::size_t n = mesh.vertices.size();
    for (const auto& [vertex, index] : std::exchange(ahead_, {})) assign(vertex, index, n, values);
    index_.resize(n, kNone);
    const auto has_none = [&](std::uint32_t corner) { return index_[corner] == kNone; };
    for (const Triangle& t : mesh.faces) {
      if (std::any_of(t.begin(), t.end(), has_none)) conflict_ = true;
    }
    std::vector<Value> result;
    if (conflict_) return result;
    result.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      if (index_[i] != kNone) result[i] = values[index_[i]];
    }
    return result;
  }
  bool used() const { return !index_.empty() || !ahead_.empty(); }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  struct Assignment {
    std::uint32_t vertex;
    std::uint32_t index;
  };
  std::vector<std::uint32_t> index_;
  std::vector<Assignment> ahead_;
  bool conflict_ = false;
};

constexpr std::uint32_t kMaxIndex = std::numeric_limits<std::uint32_t>::max();

constexpr std::array<std::string_view, 10> kIgnored = {"g",      "o",  "s",   "usemtl", "mtllib",
                                                       "usemap", "mg", "lod", "bevel",  "maplib"};
constexpr std::array<std::string_view, 6> kData = {"v", "vn", "vt", "f", "l", "p"};

template <std::size_t kSize>
bool contains(const std::array<std::string_view, kSize>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Skips blanks, and line ends after a backslash.
void skip_gap(TextCursor& text) {
  for (;;) {
    skip_blanks(text);
    if (text.at_end() || *text.at != '\\') return;
    const char* next = text.at + 1;
    if (next != text.end && *next == '\r') ++next;
    if (next != text.end && *next == '\n') ++next;
    if (next == text.at + 1) return;
    text.at = next;
  }
}

bool at_statement_end(const TextCursor& text) {
  return text.at_end() || is_line_end(*text.at) || *text.at == '#';
}

// The largest index of a kind in the faces and its position, to be checked when all are known.
struct Reach {
  std::uint32_t largest = 0;
  const char* where = nullptr;
};

class ObjReader {
 public:
  explicit ObjReader(const ShapeSource& source) : source_(source), text_(source.bytes) {}

  ShapeFile read() {
    reserve();
    for (std::size_t line = 0; !text_.at_end(); ++line) {
      read_line();
      skip_spaces(text_);
      if (line % 256 == 0) source_.progress(text_.at);
    }
    if (vertices_.empty()) source_.fail("has no vertices");
    check_reach(vertex_reach_, vertices_.size(), "vertex", "vertices");
    check_reach(normal_reach_, normals_.size(), "normal", "normals");
    check_reach(texture_reach_, textures_.size(), "texture coordinate", "texture coordinates");
    return finish();
  }

 private:
  using Texture = std::array<double, 2>;

  // Counts the lines of each kind, so that no array is copied while it grows.
  void reserve() {
    std::size_t vertices = 0, normals = 0, textures = 0;
    CancelPoll poll;
    for (const char* line = text_.at; text_.end - line > 2;) {
      vertices += line[0] == 'v' && is_blank(line[1]);
      normals += line[0] == 'v' && line[1] == 'n';
      textures += line[0] == 'v' && line[1] == 't';
      face_lines_ += line[0] == 'f' && is_blank(line[1]);
      const void* end = std::memchr(line, '\n', static_cast<std::size_t>(text_.end - line));
      line = end == nullptr ? text_.end : static_cast<const char*>(end) + 1;
      poll();
    }
    // "v 0 0 0" and "f 1 1 1" have 8 bytes with their line end; "vt 0" has 5.
    const std::size_t most = source_.bytes.size() / 8 + 1;
    vertices_.reserve(std::min(vertices, most));
    normals_.reserve(std::min(normals, most));
    textures_.reserve(std::min(textures, source_.bytes.size() / 5 + 1));
    face_lines_ = std::min(face_lines_, most);
  }

  void read_line() {
    skip_gap(text_);
    if (at_statement_end(text_)) return skip_to_line_end(text_);
    const TextCursor start = text_;
    const std::string_view word = take_word(text_);
    const char first = word[0];
    const char second = word.size() == 2 ? word[1] : ' ';
    if (first == 'v' && word.size() == 1) {
      read_vertex();
    } else if (first == 'f' && (word.size() == 1 || second == 'o')) {
      read_face();
    } else if (first == 'v' && second == 'n') {
      read_normal();
    } else if (first == 'v' && second == 't') {
      read_texture();
    } else {
      pass_over(word, start);
      return skip_to_line_end(text_);
    }
    skip_gap(text_);
    if (!at_statement_end(text_)) fail_here("does not belong here");
    skip_to_line_end(text_);
  }

  // Reads numbers to the end of the statement; more than kMost are an error.
  template <std::size_t kMost>
  std::size_t take_numbers(std::array<double, kMost>& numbers) {
    for (std::size_t n = 0;; ++n) {
      skip_gap(text_);
      if (at_statement_end(text_)) return n;
      if (n == kMost) fail_here("is one number too many");
      const TextCursor before = text_;
      if (!take_number(text_, numbers[n]) ||
          !(at_word_end(text_) || *text_.at == '\\' || *text_.at == '#')) {
        text_ = before;
        fail_here("is not a number");
      }
    }
  }

  void read_vertex() {
    std::array<double, 7> a;
    const std::size_t n = take_numbers(a);
    if (n < 3) fail_line("a vertex needs 3 coordinates, this one has " + std::to_string(n));
    const Vec3 position = {a[0], a[1], a[2]};
    if (!is_finite(position) && !not_finite_) not_finite_ = text_;
    if (vertices_.size() == kMaxIndex) fail_line("more than 4294967295 vertices");
    vertices_.push_back(position);
    if (n < 6 || !source_.attributes) return;
    if (colors_.empty()) colors_.reserve(vertices_.capacity());
    colors_.push_back({a[3], a[4], a[5]});
  }

  void read_normal() {
    std::array<double, 3> a;
    if (take_numbers(a) != 3) fail_line("a normal needs 3 numbers");
    normals_.push_back({a[0], a[1], a[2]});
  }

  void read_texture() {
    std::array<double, 3> a = {};
    if (take_numbers(a) == 0) fail_line("a texture coordinate needs a number");
    textures_.push_back({a[0], a[1]});
  }

  void read_face() {
    corners_.clear();
    for (;;) {
      skip_gap(text_);
      if (at_statement_end(text_)) break;
      read_corner();
    }
    // Polygons are stored elsewhere.
    if (n_faces_ == 0 && corners_.size() == 3) faces_.reserve(face_lines_);
    faces_.add(corners_);
    ++n_faces_;
  }

  // Reads a corner: a, a/b, a//c or a/b/c.
  void read_corner() {
    const std::uint32_t vertex = take_index(vertices_.size(), vertex_reach_);
    corners_.push_back(vertex);
    if (text_.at_end() || *text_.at != '/') return check_corner_end();
    ++text_.at;
    if (!text_.at_end() && *text_.at != '/' && !at_word_end(text_)) {
      const std::uint32_t texture = take_index(textures_.size(), texture_reach_);
      if (source_.attributes) {
        texture_of_.assign(vertex, texture, vertices_.size(), textures_);
      }
    }
    if (text_.at_end() || *text_.at != '/') return check_corner_end();
    ++text_.at;
    if (at_word_end(text_)) return;
    const std::uint32_t normal = take_index(normals_.size(), normal_reach_);
    if (source_.attributes) normal_of_.assign(vertex, normal, vertices_.size(), normals_);
    check_corner_end();
  }
  void check_corner_end() const {
    if (at_word_end(text_) || *text_.at == '\\' || *text_.at == '#') return;
    fail_here("does not belong to a corner of a face (a, a/b, a//c or a/b/c)");
  }

  // Returns an index: it counts from 1, or backwards from the last one, -1.
  std::uint32_t take_index(std::size_t n_so_far, Reach& reach) {
    std::int64_t index = 0;
    if (!take_integer(text_, index)) fail_here("is not an index");
    if (index == 0) fail_line("an index is 0; they count from 1");
    const std::int64_t place = index > 0 ? index - 1 : static_cast<std::int64_t>(n_so_far) + index;
    if (place < 0 || place >= kMaxIndex) {
      fail_line("index " + std::to_string(index) + " is out of range, there are " +
                std::to_string(n_so_far) + " so far");
    }
    const auto result = static_cast<std::uint32_t>(place);
    if (result >= reach.largest) reach = {result, text_.at};
    return result;
  }

  void check_reach(const Reach& reach, std::size_t n, const char* one, const char* many) {
    if (reach.where == nullptr || reach.largest < n) return;
    text_.at = reach.where;
    fail_line("a face names " + std::string(one) + " " + std::to_string(reach.largest + 1ull) +
              ", but the file has only " + std::to_string(n) + " " + many);
  }

  void pass_over(std::string_view word, const TextCursor& start) {
    if (word == "l" || word == "p") {
      ++lines_and_points_;
    } else if (!contains(kIgnored, word)) {
      if (unknown_++ == 0) first_unknown_ = start.at;
    }
  }

  std::vector<std::string> passed_over() {
    std::vector<std::string> warnings;
    if (lines_and_points_ > 0) {
      warnings.push_back(
          counted(lines_and_points_, "line or point element", "line and point elements") +
          " passed over");
    }
    if (unknown_ > 0) {
      text_.at = first_unknown_;
      warnings.push_back(counted(unknown_, "statement", "statements") +
                         " of unknown kind passed over, the first is " + quoted_word(text_) +
                         " in line " + std::to_string(line_number(text_)));
    }
    return warnings;
  }

  ShapeFile finish() {
    ShapeFile file;
    file.format = ShapeFormat::kObj;
    file.encoding = "ascii";
    file.warnings = passed_over();
    std::vector<Attribute> attributes = color_attributes(file.warnings);
    if (n_faces_ > 0) {
      if (not_finite_) {
        fail_at_line(source_.name, *not_finite_, "a coordinate is not a finite number");
      }
      Mesh mesh;
      mesh.faces = faces_.finish(vertices_, file.warnings);
      mesh.vertices = std::move(vertices_);
      mesh.attributes = std::move(attributes);
      add_corner_attributes(mesh, file.warnings);
      file.shape = std::move(mesh);
    } else {
      PointCloud cloud{.points = std::move(vertices_), .normals = {}, .attributes = {}};
      cloud.attributes = std::move(attributes);
      if (normals_.size() == cloud.points.size()) {
        cloud.normals = std::move(normals_);
      } else if (!normals_.empty()) {
        file.warnings.push_back(counted(normals_.size(), "normal", "normals") + " for " +
                                counted(cloud.points.size(), "point", "points") + " passed over");
      }
      file.shape = std::move(cloud);
    }
    return file;
  }

  std::vector<Attribute> color_attributes(std::vector<std::string>& warnings) const {
    if (colors_.empty()) return {};
    if (colors_.size() != vertices_.size()) {
      warnings.emplace_back("only " + std::to_string(colors_.size()) + " of " +
                            std::to_string(vertices_.size()) +
                            " vertices have a colour: colours passed over");
      return {};
    }
    return vector_attributes(colors_, {"red", "green", "blue"});
  }

  void add_corner_attributes(Mesh& mesh, std::vector<std::string>& warnings) {
    if (normal_of_.used()) {
      const std::vector<Vec3> normals = normal_of_.values_of(mesh, normals_);
      if (normals.empty()) {
        warnings.emplace_back("some vertices have several normals or none: normals passed over");
      }
      for (Attribute& a : vector_attributes(normals, {"nx", "ny", "nz"})) {
        mesh.attributes.push_back(std::move(a));
      }
    }
    if (texture_of_.used()) {
      const std::vector<Texture> textures = texture_of_.values_of(mesh, textures_);
      if (textures.empty()) {
        warnings.emplace_back(
            "some vertices have several texture coordinates or none: texture coordinates passed "
            "over");
        return;
      }
      for (std::size_t k = 0; k < 2; ++k) {
        Attribute a{.name = k == 0 ? "u" : "v", .type = ScalarType::kFloat64, .values = {}};
        for (const Texture& t : textures) a.values.push_back(t[k]);
        mesh.attributes.push_back(std::move(a));
      }
    }
  }

  [[noreturn]] void fail_line(const std::string& what) const {
    fail_at_line(source_.name, text_, what);
  }
  [[noreturn]] void fail_here(const char* what) const {
    fail_line(quoted_word(text_) + " " + what);
  }

  const ShapeSource& source_;
  TextCursor text_;
  std::optional<TextCursor> not_finite_;  // the first vertex that is not finite
  std::vector<Vec3> vertices_;
  std::vector<Vec3> colors_;
  std::vector<Vec3> normals_;
  std::vector<Texture> textures_;
  FaceList faces_;
  std::size_t n_faces_ = 0;
  std::size_t face_lines_ = 0;          // approximate upper limit
  std::vector<std::uint32_t> corners_;  // corners of the face being read
  CornerData normal_of_;
  CornerData texture_of_;
  Reach vertex_reach_, normal_reach_, texture_reach_;
  std::size_t lines_and_points_ = 0;
  std::size_t unknown_ = 0;
  const char* first_unknown_ = nullptr;
};

}  // namespace

ShapeFile read_obj(const ShapeSource& source) { return ObjReader(source).read(); }

// Returns true if only OBJ statements precede the first vertex.
bool looks_like_obj(std::span<const char> bytes) {
  TextCursor text(bytes);
  for (;;) {
    skip_spaces(text);
    if (text.at_end()) return false;
    if (*text.at != '#') {
      const std::string_view word = take_word(text);
      if (word == "v") {
        double number = 0;
        skip_gap(text);
        return take_number(text, number);
      }
      if (!contains(kData, word) && !contains(kIgnored, word)) return false;
    }
    skip_to_line_end(text);
  }
}

}  // namespace rholm
