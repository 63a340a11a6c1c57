#include "surface/level_set/mesh_piece.h"

#include <unordered_set>

#include "base/parallel.h"
#include "surface/level_set/cubes.h"

namespace rholm {

MeshPiece piece_around(const Mesh& mesh, const std::vector<std::uint32_t>& centers, double reach,
                       const Context& context) {
  constexpr std::uint32_t kOutside = ~std::uint32_t{0};
  std::unordered_set<std::uint64_t> seen, near;
  for (const std::uint32_t v : centers) {
    const Cube cube = cube_of(mesh.vertices[v], reach);
    if (!seen.insert(key_of(cube)).second) continue;
    for_each_near(cube, [&](std::uint64_t key) { near.insert(key); });
  }
  std::vector<std::uint32_t> place(mesh.vertices.size());
  parallel_for(place.size(), 16384, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      place[v] = near.contains(key_of(cube_of(mesh.vertices[v], reach))) ? 0 : kOutside;
    }
  });
  MeshPiece piece;
  for (std::uint32_t v = 0; v < place.size(); ++v) {
    if (place[v] == kOutside) continue;
    place[v] = static_cast<std::uint32_t>(piece.vertices.size());
    piece.vertices.push_back(v);
    piece.mesh.vertices.push_back(mesh.vertices[v]);
  }
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& c = mesh.triangles[t];
    const Triangle own{place[c[0]], place[c[1]], place[c[2]]};
    if (own[0] == kOutside || own[1] == kOutside || own[2] == kOutside) continue;
    piece.triangles.push_back(t);
    piece.mesh.triangles.push_back(own);
  }
  return piece;
}

}  // namespace rholm
