// A binary PLY of a mesh that comes in parts. Layer: io, private.
//
// Its bytes are those of write_shape() of the whole mesh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/file/atomic_file.h"
#include "rholm/context.h"
#include "rholm/mesh.h"

namespace rholm {

using WideTriangle = std::array<std::uint64_t, 3>;

// Where what is in the file.
class PlyLayout {
 public:
  // So many vertices and triangles; `attributes` say their names and types only. Throws Unsupported
  // for more vertices than a PLY can number.
  PlyLayout(std::uint64_t vertices, std::uint64_t triangles, std::span<const Attribute> attributes);

  const std::string& header() const { return header_; }
  std::uint64_t vertex(std::uint64_t number) const;    // the byte at which it begins
  std::uint64_t triangle(std::uint64_t number) const;  // likewise
  std::uint64_t size() const { return triangle(triangles_); }

 private:
  std::string header_;
  std::uint64_t vertices_ = 0, triangles_ = 0;
  std::size_t row_ = 0;  // bytes of a vertex
};

// The values of attributes must be of the attributes' types.
std::vector<std::byte> ply_vertices(const Mesh& part);
std::vector<std::byte> ply_triangles(std::span<const WideTriangle> triangles);

// A part of the mesh: its vertices and triangles follow each other in the whole.
struct PlyPart {
  std::uint64_t first_vertex = 0, first_triangle = 0;
  Mesh vertices = {};  // without triangles
  std::vector<WideTriangle> triangles = {};
};

// A file that appears with commit(). Its parts are written by put(), in any order, also by other
// processes, or, where the output is no regular file, one after the other. Throws Io.
class PlyParts {
 public:
  PlyParts(const std::filesystem::path& path, const PlyLayout& layout, const Context& context = {},
           AtomicFile::Writers writers = AtomicFile::Writers::kThisProcess);

  // Where put() writes; empty if parts can only come one after the other.
  const std::filesystem::path& file() const { return file_.temporary_path(); }
  static void put(const std::filesystem::path& file, const PlyLayout& layout, const PlyPart& part);
  // All vertices first.
  void append(std::span<const std::byte> bytes);
  void commit();

 private:
  AtomicFile file_;
};

}  // namespace rholm
