// The faces of a part, and the vertices that they have.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/ranked_set.h"
#include "rholm/mesh_view.h"
#include "transform/mesh_pass/block/block.h"
#include "transform/mesh_pass/division.h"
#include "transform/mesh_pass/scatter.h"

namespace rholm {

// Numbers of the corners of a block.
using BlockPlaces = std::uint32_t[3 * kTrianglesPerBlock];

struct PartMesh {
  std::size_t first_triangle = 0, n_faces = 0;  // in the mesh
  std::uint32_t first_vertex = 0;               // first vertex that the part may have
  std::size_t n_vertices = 0;
  // Vertices of the part in the order of the mesh, if they are scattered among others; else empty.
  std::vector<std::uint32_t> names;
  std::optional<RankedSet> ranks;  // ranks of the names, while faces are processed

  // Returns the number in the mesh of vertex i of the part.
  std::uint32_t name(std::size_t i) const {
    return names.empty() ? first_vertex + static_cast<std::uint32_t>(i) : names[i];
  }
  // Vertices `begin` ... `end` - 1 of the part, whose names are in a range.
  struct Places {
    std::size_t begin = 0, end = 0;
  };
  Places places(const IndexRange& range) const;
  // Returns the numbers, among the part's vertices, of the corners of n faces of the mesh. They are
  // written to `room` unless the mesh's own numbers serve.
  CornerPlaces corners(const MeshView& mesh, std::size_t first, std::size_t n,
                       BlockPlaces& room) const;
};
// Describes faces first ... first + n - 1 of the mesh, whose indices have that range and are valid.
// Calls `check` for blocks of the faces before it reads them. The mesh alone decides if names are
// given.
PartMesh part_mesh(const MeshView& mesh, std::size_t first, std::size_t n, const IndexRange& range,
                   const std::function<void(std::size_t first, std::size_t n)>& check);

}  // namespace rholm
