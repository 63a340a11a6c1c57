#include "transform/mesh_pass/part_mesh.h"

#include <algorithm>
#include <cstring>

#include "base/ranked_set.h"
#include "transform/mesh_pass/block/block.h"

namespace rholm {
namespace {

// A closed mesh has half as many vertices as triangles: where half as many again are in the range,
// the others cost less than a copy.
bool lies_together(const IndexRange& range, std::size_t n_triangles) {
  return range.size() <= n_triangles / 4 * 3 + 64;
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

MeshView gathered(const MeshView& mesh, const std::vector<std::uint32_t>& names,
                  std::vector<std::byte>& bytes) {
  const std::size_t row = mesh.coordinate == ScalarType::kFloat32 ? 12 : 24;
  bytes.resize(row * names.size());
  std::byte* to = bytes.data();
  for (const std::uint32_t name : names) {
    std::memcpy(to, mesh.vertices + name * mesh.vertex_stride, row);
    to += row;
  }
  return {.vertices = bytes.data(),
          .n_vertices = names.size(),
          .vertex_stride = row,
          .coordinate = mesh.coordinate};
}

PartMesh part_mesh(const MeshView& mesh, std::size_t first, std::size_t n, const IndexRange& range,
                   const std::function<void(std::size_t first, std::size_t n)>& check) {
  PartMesh part;
  part.n_triangles = n;
  if (lies_together(range, n)) {
    part.view = mesh;
    part.first_triangle = first;
    part.first_vertex = range.low;
    part.n_vertices = range.size();
    return part;
  }
  part.triangles.resize(3 * n);
  std::uint32_t* corners = part.triangles.data();
  RankedSet set(range.low, range.size());
  for (std::size_t t = 0; t < n; t += kTrianglesPerBlock) {
    const std::size_t count = std::min(kTrianglesPerBlock, n - t);
    check(first + t, count);
    for (std::size_t i = 0; i < count; ++i, corners += 3) {
      std::memcpy(corners, mesh.triangles + (first + t + i) * mesh.triangle_stride, 12);
      for (std::size_t k = 0; k < 3; ++k) set.add(corners[k]);
    }
  }
  part.names = set.sorted();
  for (std::uint32_t& corner : part.triangles) corner = set.rank(corner);
  part.view = gathered(mesh, part.names, part.vertices);
  part.view.triangles = reinterpret_cast<const std::byte*>(part.triangles.data());
  part.view.n_triangles = n;
  part.view.triangle_stride = 12;
  part.n_vertices = part.names.size();
  return part;
}

}  // namespace rholm
