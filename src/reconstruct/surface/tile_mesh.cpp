#include "reconstruct/surface/tile_mesh.h"

#include <algorithm>

#include "rholm/error.h"

namespace rholm {
namespace {

VertexKey key_of(const BlockCoordinates& block, std::uint16_t edge) {
  return {block[2], block[1], block[0], edge};
}

struct Foreign {
  VertexKey key;
  std::uint32_t vertex = 0;  // as extracted
};

// Returns the vertices after the first `n_own` ones that triangles have, by their keys.
std::vector<Foreign> foreign_vertices(const ExtractedSurface& surface, const BlockGrid& grid,
                                      std::size_t n_own_blocks) {
  const std::uint32_t n_own = surface.first_vertex[n_own_blocks];
  std::vector<std::uint8_t> used(surface.mesh.vertices.size() - n_own, 0);
  for (const Triangle& t : surface.mesh.faces) {
    for (const std::uint32_t v : t) {
      if (v >= n_own) used[v - n_own] = 1;
    }
  }
  std::vector<Foreign> foreign;
  for (std::size_t b = n_own_blocks; b < grid.n_blocks(); ++b) {
    for (std::uint32_t v = surface.first_vertex[b]; v < surface.first_vertex[b + 1]; ++v) {
      if (used[v - n_own] != 0) foreign.push_back({key_of(grid.blocks[b], surface.edges[v]), v});
    }
  }
  std::sort(foreign.begin(), foreign.end(),
            [](const Foreign& a, const Foreign& b) { return a.key < b.key; });
  return foreign;
}

// Sets values[n_own + i] to the value of foreign[i], and removes all values after these.
template <typename T>
void take(std::vector<T>& values, std::size_t n_own, const std::vector<Foreign>& foreign) {
  std::vector<T> taken;
  taken.reserve(foreign.size());
  for (const Foreign& one : foreign) taken.push_back(values[one.vertex]);
  values.resize(n_own);
  values.insert(values.end(), taken.begin(), taken.end());
}

}  // namespace

TileMesh tile_mesh(ExtractedSurface surface, const BlockGrid& grid, std::size_t n_own,
                   const std::vector<std::uint32_t>& border) {
  TileMesh result;
  result.n_own = surface.first_vertex[n_own];
  const std::vector<Foreign> foreign = foreign_vertices(surface, grid, n_own);
  for (const std::uint32_t b : border) {
    for (std::uint32_t v = surface.first_vertex[b]; v < surface.first_vertex[b + 1]; ++v) {
      result.shared.push_back({key_of(grid.blocks[b], surface.edges[v]), v});
    }
  }
  std::sort(result.shared.begin(), result.shared.end(),
            [](const auto& a, const auto& b) { return a.key < b.key; });
  result.mesh = std::move(surface.mesh);
  result.filled = std::move(surface.filled);
  std::vector<std::uint32_t> moved(result.mesh.vertices.size() - result.n_own, 0);
  for (std::size_t i = 0; i < foreign.size(); ++i) {
    moved[foreign[i].vertex - result.n_own] = static_cast<std::uint32_t>(result.n_own + i);
    result.foreign.push_back(foreign[i].key);
  }
  for (Triangle& t : result.mesh.faces) {
    for (std::uint32_t& v : t) {
      if (v >= result.n_own) v = moved[v - result.n_own];
    }
  }
  take(result.mesh.vertices, result.n_own, foreign);
  for (Attribute& attribute : result.mesh.attributes) take(attribute.values, result.n_own, foreign);
  if (!result.filled.empty()) take(result.filled, result.n_own, foreign);
  return result;
}

const TileMesh::Shared* find_shared(const std::vector<TileMesh::Shared>& shared,
                                    const VertexKey& key) {
  const auto found =
      std::lower_bound(shared.begin(), shared.end(), key,
                       [](const TileMesh::Shared& a, const VertexKey& k) { return a.key < k; });
  if (found == shared.end() || found->key != key) {
    throw Error(ErrorCode::kInvalidInput,
                "two tiles have different surfaces at their border: their pieces are damaged, or "
                "of different runs");
  }
  return &*found;
}

}  // namespace rholm
