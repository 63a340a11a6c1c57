#include "transform/mesh_pass/part_mesh.h"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "transform/mesh_pass/part_mesh.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rholm {
namespace HWY_NAMESPACE {

// This is compiled for each target, because most targets have an instruction that counts bits.
void RankCorners(const RankedSet& set, const std::byte* record, std::size_t stride, std::size_t n,
                 std::uint32_t* ranks) {
  for (std::size_t t = 0; t < n; ++t, record += stride, ranks += 3) {
    std::uint32_t corner[3];
    std::memcpy(corner, record, sizeof corner);
    for (int k = 0; k < 3; ++k) ranks[k] = set.rank(corner[k]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace rholm
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rholm {

HWY_EXPORT(RankCorners);

namespace {

// A closed mesh has half as many vertices as faces. If the range has at most half as many again,
// the others in the range cost less than names.
bool lies_together(const IndexRange& range, std::size_t n_faces) {
  return range.size() <= n_faces / 4 * 3 + 64;
}

}  // namespace

PartMesh::Places PartMesh::places(const IndexRange& range) const {
  const auto at = [&](std::uint64_t name) -> std::size_t {
    if (!names.empty()) {
      return static_cast<std::size_t>(std::lower_bound(names.begin(), names.end(), name) -
                                      names.begin());
    }
    const std::uint64_t end = first_vertex + std::uint64_t{n_vertices};
    return std::clamp<std::uint64_t>(name, first_vertex, end) - first_vertex;
  };
  if (range.low > range.high) return {};
  return {at(range.low), at(std::uint64_t{range.high} + 1)};
}

CornerPlaces PartMesh::corners(const MeshView& mesh, std::size_t first, std::size_t n,
                               BlockPlaces& room) const {
  const std::size_t stride = mesh.face_stride;
  const std::byte* const record = mesh.faces + first * stride;
  if (!ranks) return {record, stride, first_vertex};
  HWY_DYNAMIC_DISPATCH(RankCorners)(*ranks, record, stride, n, room);
  return {reinterpret_cast<const std::byte*>(room), 3 * sizeof room[0], 0};
}

PartMesh part_mesh(const MeshView& mesh, std::size_t first, std::size_t n, const IndexRange& range,
                   const std::function<void(std::size_t first, std::size_t n)>& check) {
  PartMesh part;
  part.first_triangle = first;
  part.n_faces = n;
  if (lies_together(range, n)) {
    part.first_vertex = range.low;
    part.n_vertices = range.size();
    return part;
  }
  RankedSet& set = part.ranks.emplace(range.low, range.size());
  for (std::size_t t = 0; t < n; t += kTrianglesPerBlock) {
    const std::size_t count = std::min(kTrianglesPerBlock, n - t);
    check(first + t, count);
    const std::byte* record = mesh.faces + (first + t) * mesh.face_stride;
    for (std::size_t i = 0; i < count; ++i, record += mesh.face_stride) {
      std::uint32_t corner[3];
      std::memcpy(corner, record, sizeof corner);
      for (std::size_t k = 0; k < 3; ++k) set.add(corner[k]);
    }
  }
  part.names = set.sorted();
  part.n_vertices = part.names.size();
  return part;
}

}  // namespace rholm
#endif  // HWY_ONCE
