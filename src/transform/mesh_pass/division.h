// A mesh pass in parts: ranges of the triangles as they lie, fixed by their number, the degree and
// the plan, whatever there is of threads, ranks and memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rholm/mesh_view.h"

namespace rholm {

struct Division {
  std::size_t n_triangles = 0;
  std::size_t size = 0;   // triangles of every part but the last: whole blocks
  std::size_t count = 0;  // of parts

  std::size_t first(std::size_t p) const { return p * size; }
  std::size_t n(std::size_t p) const;
};
// At most `wanted` parts of the same size.
Division divide_triangles(std::size_t n_triangles, std::size_t wanted);

// As many parts as grids pay; beyond 2^23 triangles so many that memory does not grow with the
// mesh.
std::size_t part_count(std::size_t n_triangles, int degree, std::size_t grids);

// The smallest and the largest index of a vertex; none if low > high.
struct IndexRange {
  std::uint32_t low = UINT32_MAX, high = 0;
  std::size_t size() const { return low > high ? 0 : std::size_t{high} - low + 1; }
};
// Of n triangles from `first` on.
IndexRange index_range(const MeshView& mesh, std::size_t first, std::size_t n);

// The indices in the ranges of part p and those behind it: in order, without overlaps.
std::vector<IndexRange> ranges_from(const std::vector<IndexRange>& ranges, std::size_t p);
bool contains(const std::vector<IndexRange>& in_order, std::uint32_t index);

// Whether the vertices of parts lie among those of others, by what some of their blocks tell.
bool parts_overlap(const MeshView& mesh, const Division& division);

// What of the range of part p lies in those of others: in order, without overlaps.
std::vector<IndexRange> shared_ranges(const std::vector<IndexRange>& ranges, std::size_t p);

}  // namespace rholm
