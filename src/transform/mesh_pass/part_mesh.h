// The triangles of a part, and which vertices they have.
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

// Numbers for the corners of a block.
using BlockPlaces = std::uint32_t[3 * kTrianglesPerBlock];

struct PartMesh {
  std::size_t first_triangle = 0, n_triangles = 0;  // in the mesh
  std::uint32_t first_vertex = 0;                   // of those the part may have
  std::size_t n_vertices = 0;
  // Where vertices lie scattered among others: those that the part has, in the order of the mesh.
  std::vector<std::uint32_t> names;
  std::optional<RankedSet> ranks;  // of the names, while triangles are worked

  // The number in the mesh of vertex i of the part.
  std::uint32_t name(std::size_t i) const {
    return names.empty() ? first_vertex + static_cast<std::uint32_t>(i) : names[i];
  }
  // Vertices `begin` to `end` of the part have names in the range.
  struct Places {
    std::size_t begin = 0, end = 0;
  };
  Places places(const IndexRange& range) const;
  // Which vertices of the part the corners of n triangles of the mesh are, in `room` if the numbers
  // of the mesh do not say it.
  CornerPlaces corners(const MeshView& mesh, std::size_t first, std::size_t n,
                       BlockPlaces& room) const;
};
// Triangles first ... first + n - 1 of the mesh, whose indices have that range and are valid.
// Before they are looked at, `check` is called for blocks of them. Whether names are given depends
// on the mesh alone.
PartMesh part_mesh(const MeshView& mesh, std::size_t first, std::size_t n, const IndexRange& range,
                   const std::function<void(std::size_t first, std::size_t n)>& check);

}  // namespace rholm
