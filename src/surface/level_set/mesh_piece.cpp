#include "surface/level_set/mesh_piece.h"

#include "base/indices_where.h"
#include "surface/level_set/cubes.h"

namespace rholm {

NearPlaces::NearPlaces(std::span<const Vec3> centers, double reach) : reach_(reach) {
  std::unordered_set<std::uint64_t> seen;
  for (const Vec3& center : centers) {
    const Cube cube = cube_of(center, reach);
    if (!seen.insert(key_of(cube)).second) continue;
    for_each_near(cube, [&](std::uint64_t key) {
      cubes_.insert(key);
      filter_.set(filter_of(key));
    });
  }
}

bool NearPlaces::has(const Vec3& place) const {
  const std::uint64_t key = key_of(cube_of(place, reach_));
  return filter_[filter_of(key)] && cubes_.contains(key);
}

MeshPiece piece_around(const Mesh& mesh, const std::vector<std::uint32_t>& centers, double reach,
                       const Context& context) {
  constexpr std::uint32_t kOutside = ~std::uint32_t{0};
  std::vector<Vec3> places;
  places.reserve(centers.size());
  for (const std::uint32_t v : centers) places.push_back(mesh.vertices[v]);
  const NearPlaces near(places, reach);
  MeshPiece piece;
  piece.vertices = indices_where(mesh.vertices.size(), context,
                                 [&](std::uint32_t v) { return near.has(mesh.vertices[v]); });
  std::vector<std::uint32_t> place(mesh.vertices.size(), kOutside);
  for (const std::uint32_t v : piece.vertices) {
    place[v] = static_cast<std::uint32_t>(piece.mesh.vertices.size());
    piece.mesh.vertices.push_back(mesh.vertices[v]);
  }
  piece.faces = indices_where(mesh.faces.size(), context, [&](std::uint32_t t) {
    const Triangle& c = mesh.faces[t];
    return place[c[0]] != kOutside && place[c[1]] != kOutside && place[c[2]] != kOutside;
  });
  for (const std::uint32_t t : piece.faces) {
    const Triangle& c = mesh.faces[t];
    piece.mesh.faces.push_back({place[c[0]], place[c[1]], place[c[2]]});
  }
  return piece;
}

}  // namespace rholm
