// The triangles of a part, and their vertices side by side.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "rholm/mesh_view.h"
#include "transform/mesh_pass/division.h"

namespace rholm {

struct PartMesh {
  MeshView view;                   // of the whole mesh, or of the copy below
  std::size_t first_triangle = 0;  // of the part, in the view
  std::size_t n_triangles = 0;
  std::uint32_t first_vertex = 0;  // of those the part may have, in the view
  std::size_t n_vertices = 0;
  // A copy, where vertices lie scattered among others: the vertices of the part, in the order of
  // the mesh, which numbers they have there, and the triangles.
  std::vector<std::uint32_t> names;
  std::vector<std::byte> vertices;
  std::vector<std::uint32_t> triangles;

  // The number in the mesh of vertex first_vertex + i of the view.
  std::uint32_t name(std::size_t i) const {
    return names.empty() ? first_vertex + static_cast<std::uint32_t>(i) : names[i];
  }
  // Vertices `begin` to `end`, counted from first_vertex, have names in the range.
  struct Places {
    std::size_t begin = 0, end = 0;
  };
  Places places(const IndexRange& range) const;
};
// Triangles first ... first + n - 1 of the mesh, whose indices have that range and are valid.
// Before a copy is made, `check` is called for blocks of triangles. Whether one is made depends on
// the mesh alone.
PartMesh part_mesh(const MeshView& mesh, std::size_t first, std::size_t n, const IndexRange& range,
                   const std::function<void(std::size_t first, std::size_t n)>& check);

// Some vertices of a mesh, one after the other, without triangles; good as long as `bytes`.
MeshView gathered(const MeshView& mesh, const std::vector<std::uint32_t>& names,
                  std::vector<std::byte>& bytes);

}  // namespace rholm
