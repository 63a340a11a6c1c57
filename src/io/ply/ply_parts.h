// A binary PLY of a mesh that is written in parts. Layer: io, private.
//
// The file has the same bytes as the file of write_shape() for the whole mesh.
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

// Positions of vertices and triangles in the file.
class PlyLayout {
 public:
  // Takes the numbers of vertices and triangles; of `attributes` only the names and types count.
  // Throws Unsupported for more vertices than PLY indices can number.
  PlyLayout(std::uint64_t vertices, std::uint64_t triangles, std::span<const Attribute> attributes);

  const std::string& header() const { return header_; }
  std::uint64_t vertex(std::uint64_t number) const;    // its first byte
  std::uint64_t triangle(std::uint64_t number) const;  // its first byte
  std::uint64_t size() const { return triangle(triangles_); }

 private:
  std::string header_;
  std::uint64_t vertices_ = 0, triangles_ = 0;
  std::size_t row_ = 0;  // bytes of a vertex
};

// The values of attributes must fit the attributes' types.
std::vector<std::byte> ply_vertices(const Mesh& part);
std::vector<std::byte> ply_triangles(std::span<const WideTriangle> triangles);

// A part of the mesh, whose vertices and triangles are each consecutive in the whole mesh.
struct PlyPart {
  std::uint64_t first_vertex = 0, first_triangle = 0;
  Mesh vertices = {};  // without triangles
  std::vector<WideTriangle> faces = {};
};

// A file that exists after commit(). put() writes parts in any order, also in other processes.
// If the output is no regular file, append() writes parts in order. Throws Io.
class PlyParts {
 public:
  PlyParts(const std::filesystem::path& path, const PlyLayout& layout, const Context& context = {},
           AtomicFile::Writers writers = AtomicFile::Writers::kThisProcess);

  // Returns the file for put(); empty if parts must be written in order.
  const std::filesystem::path& file() const { return file_.temporary_path(); }
  static void put(const std::filesystem::path& file, const PlyLayout& layout, const PlyPart& part);
  // Appends bytes in order, all vertices first.
  void append(std::span<const std::byte> bytes);
  void commit();

 private:
  AtomicFile file_;
};

}  // namespace rholm
