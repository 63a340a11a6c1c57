// Divides a mesh pass into parts: ranges of the faces in file order. Parts depend on the number of
// faces, the degree and the plan, not on threads, ranks and memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh_view.h"

namespace rholm {

struct Division {
  std::size_t n_faces = 0;
  std::size_t size = 0;   // faces of each part but the last, in whole blocks
  std::size_t count = 0;  // number of parts

  std::size_t first(std::size_t p) const { return p * size; }
  std::size_t n(std::size_t p) const;
};
// Divides into at most `wanted` parts of the same size.
Division divide_triangles(std::size_t n_faces, std::size_t wanted);

// Returns the number of parts for which grids pay. Beyond 2^23 faces, returns the number for which
// memory does not grow with the mesh.
std::size_t part_count(std::size_t n_faces, int degree, std::size_t grids);

// The smallest and the largest index of a vertex; there is none if low > high.
struct IndexRange {
  std::uint32_t low = UINT32_MAX, high = 0;
  std::size_t size() const { return low > high ? 0 : std::size_t{high} - low + 1; }
};
// Returns the range of n faces from `first` on.
IndexRange index_range(const MeshView& mesh, std::size_t first, std::size_t n);

// Returns the indices in the ranges of part p and later parts, in order, without overlaps.
std::vector<IndexRange> ranges_from(const std::vector<IndexRange>& ranges, std::size_t p);
bool contains(const std::vector<IndexRange>& in_order, std::uint32_t index);

// Returns true if vertices of parts lie among vertices of other parts, judged by some blocks.
bool parts_overlap(const MeshView& mesh, const Division& division);

// Returns the indices in part p's range and in ranges of others, in order, without overlaps.
std::vector<IndexRange> shared_ranges(const std::vector<IndexRange>& ranges, std::size_t p);

}  // namespace rholm
