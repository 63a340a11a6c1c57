#include "transform/mesh_pass/division.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <utility>

#include "transform/mesh_pass/block/block.h"

namespace rholm {
namespace {

// Smallest part of a large mesh, and smallest large mesh. Chosen: parts are large against their
// borders, and their lumps (8 ... 50 MB) are small.
constexpr std::size_t kLargeSize = std::size_t{1} << 20, kLargeMesh = std::size_t{1} << 23;

}  // namespace

std::size_t Division::n(std::size_t p) const { return std::min(size, n_faces - first(p)); }

Division divide_triangles(std::size_t n_faces, std::size_t wanted) {
  const std::size_t blocks = (n_faces + kTrianglesPerBlock - 1) / kTrianglesPerBlock;
  const std::size_t each = (blocks + wanted - 1) / wanted;
  return {
      .n_faces = n_faces, .size = each * kTrianglesPerBlock, .count = (blocks + each - 1) / each};
}

std::size_t part_count(std::size_t n_faces, int degree, std::size_t grids) {
  if (n_faces <= kLargeMesh) return grids;
  // A grid has some 3 L^2 cells. Each costs a tenth of a face to make and to add.
  const auto degrees = static_cast<std::size_t>(degree);
  const std::size_t size = std::max(kLargeSize, 2 * degrees * degrees);
  return (n_faces + size - 1) / size;
}

IndexRange index_range(const MeshView& mesh, std::size_t first, std::size_t n) {
  using Four [[gnu::vector_size(16)]] = std::uint32_t;
  const std::size_t stride = mesh.face_stride;
  const std::byte* record = mesh.faces + first * stride;
  Four low = {UINT32_MAX, UINT32_MAX, UINT32_MAX, 0}, high = {};
  std::size_t t = 0;
  // Each record but the last is read with 4 bytes beyond it.
  for (; t + 1 < n; ++t, record += stride) {
    Four corners;
    std::memcpy(&corners, record, sizeof corners);
    low = corners < low ? corners : low;
    high = corners > high ? corners : high;
  }
  IndexRange range;
  const auto add = [&](std::uint32_t smallest, std::uint32_t largest) {
    range.low = std::min(range.low, smallest);
    range.high = std::max(range.high, largest);
  };
  for (std::size_t i = 0; i < 3 && t > 0; ++i) add(low[i], high[i]);
  for (; t < n; ++t, record += stride) {
    std::uint32_t corners[3];
    std::memcpy(corners, record, sizeof corners);
    for (const std::uint32_t corner : corners) add(corner, corner);
  }
  return range;
}

bool parts_overlap(const MeshView& mesh, const Division& division) {
  // If vertices are more than the faces can have, lumps of all vertices are too many.
  if (mesh.n_vertices > mesh.n_faces) return false;
  constexpr std::size_t kLooks = 16;  // chosen: some 30 us
  std::size_t covered = 0;
  for (std::size_t p = 0; p < division.count; ++p) {
    const std::size_t blocks = (division.n(p) + kTrianglesPerBlock - 1) / kTrianglesPerBlock;
    const std::size_t looks = std::min(blocks, kLooks);
    IndexRange range;
    for (std::size_t k = 0; k < looks; ++k) {
      const std::size_t at = k * blocks / looks * kTrianglesPerBlock;
      const IndexRange block = index_range(mesh, division.first(p) + at,
                                           std::min(kTrianglesPerBlock, division.n(p) - at));
      range.low = std::min(range.low, block.low);
      range.high = std::max(range.high, block.high);
    }
    covered += range.size();
  }
  return 2 * covered > 3 * mesh.n_vertices;
}

namespace {

std::vector<IndexRange> merged(std::vector<IndexRange> ranges) {
  std::sort(ranges.begin(), ranges.end(),
            [](const IndexRange& a, const IndexRange& b) { return a.low < b.low; });
  std::size_t n = 0;
  for (const IndexRange& range : ranges) {
    if (n > 0 && range.low <= ranges[n - 1].high) {
      ranges[n - 1].high = std::max(ranges[n - 1].high, range.high);
    } else {
      ranges[n++] = range;
    }
  }
  ranges.resize(n);
  return ranges;
}

}  // namespace

std::vector<IndexRange> ranges_from(const std::vector<IndexRange>& ranges, std::size_t p) {
  std::vector<IndexRange> later(ranges.begin() + static_cast<std::ptrdiff_t>(p), ranges.end());
  std::erase_if(later, [](const IndexRange& range) { return range.size() == 0; });
  return merged(std::move(later));
}

bool contains(const std::vector<IndexRange>& in_order, std::uint32_t index) {
  const auto behind =
      std::upper_bound(in_order.begin(), in_order.end(), index,
                       [](std::uint32_t i, const IndexRange& range) { return i < range.low; });
  return behind != in_order.begin() && index <= std::prev(behind)->high;
}

std::vector<IndexRange> shared_ranges(const std::vector<IndexRange>& ranges, std::size_t p) {
  const IndexRange& own = ranges[p];
  std::vector<IndexRange> shared;
  for (std::size_t q = 0; q < ranges.size(); ++q) {
    const IndexRange both = {std::max(own.low, ranges[q].low), std::min(own.high, ranges[q].high)};
    if (q != p && both.low <= both.high) shared.push_back(both);
  }
  return merged(std::move(shared));
}

}  // namespace rholm
