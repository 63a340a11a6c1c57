// OFF: a header word [ST][C][N]OFF, counts, vertices, faces; # begins a comment.
// Source: Geomview manual, "OFF Files". A vertex has x y z, then (N) a normal, (C) a colour, (ST)
// texture coordinates. As in later writers, the counts may lack the edges, and a vertex colour may
// have three or four components, integers 0 ... 255 or fractions.
#include <algorithm>
#include <array>
#include <limits>

#include "base/plain_text.h"
#include "io/file/number_text.h"
#include "io/shapes/face_list.h"
#include "io/shapes/shape_source.h"
#include "io/shapes/shape_writers.h"
#include "rholm/error.h"

namespace rholm {
namespace {

struct OffKind {
  bool normals = false;
  bool colors = false;
  bool textures = false;
  bool four_dimensional = false;
  bool n_dimensional = false;
};

// Parses the variant that a header word names; returns false if it is no header word.
bool parse_header_word(std::string_view word, OffKind& kind) {
  const auto take = [&word](std::string_view prefix) {
    if (!word.starts_with(prefix)) return false;
    word.remove_prefix(prefix.size());
    return true;
  };
  kind.textures = take("ST");
  kind.colors = take("C");
  kind.normals = take("N");
  kind.four_dimensional = take("4");
  kind.n_dimensional = take("n");
  return word == "OFF";
}

// Moves to the next word, over comments and line ends.
void skip_to_word(TextCursor& text) {
  for (;;) {
    skip_spaces(text);
    if (text.at_end() || *text.at != '#') return;
    skip_to_line_end(text);
  }
}

bool at_line_data_end(TextCursor& text) {
  skip_blanks(text);
  return text.at_end() || is_line_end(*text.at) || *text.at == '#';
}

class OffReader {
 public:
  explicit OffReader(const ShapeSource& source) : source_(source), text_(source.bytes) {}

  ShapeFile read() {
    read_header();
    read_counts();
    read_vertices();
    read_faces();
    skip_to_word(text_);
    if (!text_.at_end()) {
      warnings_.push_back(counted(static_cast<std::size_t>(text_.end - text_.at), "byte", "bytes") +
                          " after the last face passed over");
    }
    return finish();
  }

 private:
  void read_header() {
    skip_to_word(text_);
    TextCursor after = text_;
    const std::string_view word = take_word(after);
    if (!parse_header_word(word, kind_)) {
      kind_ = {};  // without a header word, the counts come first
      return;
    }
    text_ = after;
    if (kind_.four_dimensional || kind_.n_dimensional) {
      fail_unsupported(in_quotes(word) + " has coordinates in other than 3 dimensions");
    }
    skip_blanks(after);
    if (take_word(after) == "BINARY") {
      fail_unsupported("binary OFF is not supported: convert it to text OFF or to PLY");
    }
  }

  void read_counts() {
    n_vertices_ = take_count_of_line("the number of vertices");
    n_faces_ = take_count_of_line("the number of faces");
    if (!at_line_data_end(text_)) take_count("the number of edges");
    if (n_vertices_ == 0) source_.fail("has no vertices");
    // A vertex takes at least "0 0 0\n", a face "1 0\n"; the last line end may be missing.
    const auto left = static_cast<std::size_t>(text_.end - text_.at) + 1;
    if (n_vertices_ > left / 6 || n_faces_ > (left - 6 * n_vertices_) / 4) {
      source_.fail("truncated: the " + std::to_string(source_.bytes.size()) +
                   " bytes of the file cannot hold " + std::to_string(n_vertices_) +
                   " vertices and " + std::to_string(n_faces_) + " faces");
    }
    if (n_vertices_ > std::numeric_limits<std::uint32_t>::max()) {
      source_.fail("has " + std::to_string(n_vertices_) + " vertices, the limit is 4294967295");
    }
  }

  void read_vertices() {
    vertices_.reserve(n_vertices_);
    for (std::uint64_t i = 0; i < n_vertices_; ++i) {
      const Vec3 position = take_vector();
      // Points that are not finite are dropped after all have been read.
      if (n_faces_ > 0 && !is_finite(position)) fail_line("a coordinate is not a finite number");
      vertices_.push_back(position);
      if (kind_.normals) normals_.push_back(take_vector());
      if (i == 0) plan_colors();
      if (n_colors_ > 0) read_color();
      if (kind_.textures) textures_.push_back({take_number_here(), take_number_here(), 0});
      if (i % 1024 == 0) source_.progress(text_.at);
    }
  }

  // The rest of the first vertex's line gives the number of colour components. A file without the C
  // may still have colours.
  void plan_colors() {
    TextCursor rest = text_;
    std::size_t n = 0;
    for (; !at_line_data_end(rest); ++n) take_word(rest);
    if (kind_.textures) n = n > 2 ? n - 2 : 0;
    if (kind_.colors && n != 3 && n != 4) {
      fail_line("a vertex colour has 3 or 4 components, here are " + std::to_string(n));
    }
    if (kind_.colors || n == 3 || n == 4) n_colors_ = n;
  }

  void read_color() {
    std::array<double, 4> color = {};
    for (std::size_t k = 0; k < n_colors_; ++k) {
      if (at_line_data_end(text_)) {
        fail_line("a vertex has fewer colour components than the first, which has " +
                  std::to_string(n_colors_));
      }
      const char* first = text_.at;
      color[k] = take_number_here();
      const bool fraction =
          std::any_of(first, text_.at, [](char c) { return c == '.' || c == 'e' || c == 'E'; });
      colors_are_bytes_ =
          colors_are_bytes_ && !fraction && is_value_of(ScalarType::kUint8, color[k]);
      largest_color_ = std::max(largest_color_, color[k]);
    }
    if (!source_.attributes) return;
    colors_.push_back({color[0], color[1], color[2]});
    if (n_colors_ == 4) alphas_.push_back(color[3]);
  }

  void read_faces() {
    faces_.reserve(n_faces_);
    for (std::uint64_t i = 0; i < n_faces_; ++i) {
      const std::uint64_t n = take_count("the number of corners of a face");
      corners_.clear();
      for (std::uint64_t k = 0; k < n; ++k) {
        const std::uint64_t index = take_count("a vertex index");
        if (index >= n_vertices_) {
          fail_line("a face names vertex " + std::to_string(index) + ", but the " +
                    std::to_string(n_vertices_) + " vertices are numbered from 0");
        }
        corners_.push_back(static_cast<std::uint32_t>(index));
      }
      faces_.add(corners_);
      skip_to_line_end(text_);  // a colour
      if (i % 1024 == 0) source_.progress(text_.at);
    }
  }

  std::uint64_t take_count(const char* what) {
    skip_to_word(text_);
    if (text_.at_end()) fail_truncated();
    const TextCursor before = text_;
    std::uint64_t count = 0;
    if (!take_integer(text_, count) || !(at_word_end(text_) || *text_.at == '#')) {
      text_ = before;
      fail_line(quoted_word(text_) + " is not " + what);
    }
    return count;
  }

  std::uint64_t take_count_of_line(const char* what) {
    skip_to_word(text_);
    if (text_.at_end()) source_.fail(std::string("truncated: ") + what + " is missing");
    return take_count(what);
  }

  double take_number_here() {
    skip_to_word(text_);
    if (text_.at_end()) fail_truncated();
    const TextCursor before = text_;
    double value = 0;
    if (!take_number(text_, value) || !(at_word_end(text_) || *text_.at == '#')) {
      text_ = before;
      fail_line(quoted_word(text_) + " is not a number");
    }
    return value;
  }
  Vec3 take_vector() {
    const double x = take_number_here();
    const double y = take_number_here();
    return {x, y, take_number_here()};
  }

  ShapeFile finish() {
    std::vector<Attribute> attributes = color_attributes();
    if (source_.attributes && n_faces_ > 0) {
      append(attributes, vector_attributes(normals_, {"nx", "ny", "nz"}));
    }
    if (source_.attributes) {
      std::vector<Attribute> uvw = vector_attributes(textures_, {"u", "v", ""});
      if (!uvw.empty()) uvw.pop_back();
      append(attributes, std::move(uvw));
    }
    ShapeFile file;
    file.format = ShapeFormat::kOff;
    file.encoding = "ascii";
    if (n_faces_ > 0) {
      Mesh mesh;
      mesh.faces = faces_.finish(vertices_, warnings_);
      mesh.vertices = std::move(vertices_);
      mesh.attributes = std::move(attributes);
      file.shape = std::move(mesh);
    } else {
      file.shape = PointCloud{.points = std::move(vertices_),
                              .normals = std::move(normals_),
                              .attributes = std::move(attributes)};
    }
    file.warnings = std::move(warnings_);
    return file;
  }

  static void append(std::vector<Attribute>& all, std::vector<Attribute> more) {
    for (Attribute& a : more) all.push_back(std::move(a));
  }

  // Integers up to 255 are bytes, unless none is above 1: then they are fractions like 0 0 1 1.
  std::vector<Attribute> color_attributes() const {
    std::vector<Attribute> attributes = vector_attributes(colors_, {"red", "green", "blue"});
    if (!alphas_.empty()) {
      attributes.push_back({.name = "alpha", .type = ScalarType::kFloat64, .values = alphas_});
    }
    if (colors_are_bytes_ && largest_color_ > 1) {
      for (Attribute& a : attributes) a.type = ScalarType::kUint8;
    }
    return attributes;
  }

  [[noreturn]] void fail_line(const std::string& what) const {
    fail_at_line(source_.name, text_, what);
  }
  [[noreturn]] void fail_truncated() const {
    source_.fail("truncated: the file ends before its " + std::to_string(n_vertices_) +
                 " vertices and " + std::to_string(n_faces_) + " faces do");
  }
  [[noreturn]] void fail_unsupported(const std::string& what) const {
    throw Error(ErrorCode::kUnsupported, source_.name + ": " + what);
  }

  const ShapeSource& source_;
  TextCursor text_;
  OffKind kind_;
  std::uint64_t n_vertices_ = 0;
  std::uint64_t n_faces_ = 0;
  std::vector<Vec3> vertices_;
  std::vector<Vec3> normals_;
  std::vector<Vec3> colors_;
  std::vector<double> alphas_;
  std::vector<Vec3> textures_;  // z unused
  std::size_t n_colors_ = 0;    // components
  bool colors_are_bytes_ = true;
  double largest_color_ = 0;
  FaceList faces_;
  std::vector<std::uint32_t> corners_;  // corners of the face being read
  std::vector<std::string> warnings_;
};

}  // namespace

ShapeFile read_off(const ShapeSource& source) { return OffReader(source).read(); }

bool looks_like_off(std::span<const char> bytes) {
  TextCursor text(bytes);
  skip_to_word(text);
  OffKind kind;
  return parse_header_word(take_word(text), kind);
}

std::vector<std::string> format_off(const ShapeView& shape, const ShapeWriting&,
                                    OutputBuffer& out) {
  const NormalRange normals(shape);
  std::vector<const ScalarRange*> colors;
  if (const auto group =
          find_group<4, ScalarRange>(shape.attributes, {"red", "green", "blue", "alpha"})) {
    colors.assign(group->begin(), group->end());
  } else if (const auto opaque =
                 find_group<3, ScalarRange>(shape.attributes, {"red", "green", "blue"})) {
    colors.assign(opaque->begin(), opaque->end());
  }
  if (!colors.empty()) out.text("C");
  if (!normals.empty()) out.text("N");
  out.text("OFF\n");
  out.number(shape.points.size(), ' ');
  out.number(shape.faces.size(), ' ');
  out.text("0\n");
  shape.points.visit([&](std::size_t i, const Vec3& point) {
    put_vector(point, normals.empty() && colors.empty() ? '\n' : ' ', out);
    if (!normals.empty()) put_vector(normals[i], colors.empty() ? '\n' : ' ', out);
    for (const ScalarRange* color : colors) {
      out.number((*color)[i], color == colors.back() ? '\n' : ' ');
    }
    out.rows(1);
  });
  shape.faces.visit([&](std::size_t, const Triangle& t) {
    out.text("3 ");
    out.number(t[0], ' ');
    out.number(t[1], ' ');
    out.number(t[2], '\n');
    out.rows(1);
  });
  return {};
}

}  // namespace rholm
