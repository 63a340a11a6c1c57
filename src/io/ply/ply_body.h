// The data of a PLY file, element by element, in its two kinds of encoding. Layer: io.
#pragma once

#include <cstddef>
#include <cstdint>

#include "io/ply/ply_header.h"
#include "io/ply/ply_vertices.h"
#include "io/shapes/face_list.h"

namespace rholm {

// Collects faces from lists or strips and checks their indices.
class PlyFaces {
 public:
  PlyFaces(const ShapeSource& source, std::uint64_t n_vertices)
      : source_(source), n_vertices_(n_vertices) {}

  std::uint64_t n_vertices() const { return n_vertices_; }
  // Adds a corner of a strip; -1 ends the strip, and the next index begins another. Reverses every
  // second triangle, and skips triangles with equal corners, which only join strips.
  void add_to_strip(std::int64_t index);
  void end_strip() { strip_length_ = 0; }
  [[noreturn]] void fail_index(std::uint64_t face, std::int64_t index) const;

  FaceList list;

 private:
  const ShapeSource& source_;
  std::uint64_t n_vertices_;
  std::size_t strip_length_ = 0;
  std::uint32_t strip_[2] = {};  // the last two corners
};

// Reads elements in order: `element` is always the next one of the header. All members throw
// InvalidInput if the data are truncated or malformed. A count that the rest of the file cannot
// hold is refused before memory is allocated for it.
class PlyBinaryBody {
 public:
  PlyBinaryBody(const ShapeSource& source, const PlyHeader& header);
  void read_vertices(const PlyElement& element, PlyVertices& vertices);
  void read_faces(const PlyElement& element, std::size_t list, PlyFaces& faces);
  void read_strips(const PlyElement& element, std::size_t list, PlyFaces& faces);
  void skip(const PlyElement& element);
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }  // bytes

 private:
  template <class Index, bool kSwap>
  void read_face_rows(const PlyElement& element, std::size_t list, PlyFaces& faces);
  template <bool kSwap>
  std::uint64_t read_plain_triangles(const PlyElement& element, PlyFaces& faces);
  void read_varying_vertices(const PlyElement& element, PlyVertices& vertices);
  void skip_properties(const PlyElement& element, std::size_t first, std::size_t last);
  void skip_bytes(const PlyElement& element, std::uint64_t n, std::size_t size);
  std::uint64_t take_count(const PlyElement& element, const PlyProperty& list);
  void require(const PlyElement& element, std::uint64_t n, std::size_t size) const;
  [[noreturn]] void fail_truncated(const PlyElement& element) const;

  const ShapeSource& source_;
  const char* at_;
  const char* end_;
  bool swap_;
};

class PlyTextBody {
 public:
  PlyTextBody(const ShapeSource& source, const PlyHeader& header);
  void read_vertices(const PlyElement& element, PlyVertices& vertices);
  void read_faces(const PlyElement& element, std::size_t list, PlyFaces& faces);
  void read_strips(const PlyElement& element, std::size_t list, PlyFaces& faces);
  void skip(const PlyElement& element);
  std::size_t left();  // bytes after the last element, without spaces

 private:
  void require_rows(const PlyElement& element) const;
  double take_value(const PlyElement& element);
  std::int64_t take_index(const PlyElement& element);
  std::uint64_t take_count(const PlyElement& element);
  void skip_properties(const PlyElement& element, std::size_t first, std::size_t last);
  [[noreturn]] void fail_value(const PlyElement& element, const char* wanted) const;

  const ShapeSource& source_;
  TextCursor text_;
};

}  // namespace rholm
