#include "reconstruct/surface/tile_parts.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/shared_sets.h"
#include "rholm/error.h"
#include "shape/normal_attributes.h"

namespace rholm {
namespace {

constexpr std::uint32_t kNone = ~std::uint32_t{0};

// Numbers components by the order of their first triangles; kNone where there is none.
std::vector<std::uint32_t> number_components(const Mesh& mesh, const Context& context) {
  SharedSets sets = connected_vertices(mesh, context);
  std::vector<std::uint32_t> of_root(mesh.vertices.size(), kNone);
  std::uint32_t n = 0;
  for (const Triangle& t : mesh.faces) {
    std::uint32_t& component = of_root[sets.find(t[0])];
    if (component == kNone) component = n++;
  }
  std::vector<std::uint32_t> of_vertex(mesh.vertices.size());
  for (std::uint32_t v = 0; v < of_vertex.size(); ++v) of_vertex[v] = of_root[sets.find(v)];
  return of_vertex;
}

// Returns the sums of the area vectors of the triangles at the vertices first ... end - 1 that have
// no normal.
std::map<std::uint32_t, Vec3> sums_without_normal(TileMesh& part, std::size_t first,
                                                  std::size_t end) {
  const NormalAttributes normals = normal_attributes(part.mesh);
  std::map<std::uint32_t, Vec3> sums;
  std::vector<std::uint8_t> has_none(part.mesh.vertices.size(), 0);
  for (auto v = static_cast<std::uint32_t>(first); v < end; ++v) {
    if (!(normals[v] == Vec3{})) continue;
    sums[v] = {};
    has_none[v] = 1;
  }
  if (sums.empty()) return sums;
  for (const Triangle& t : part.mesh.faces) {
    if ((has_none[t[0]] | has_none[t[1]] | has_none[t[2]]) == 0) continue;
    const Vec3& a = part.mesh.vertices[t[0]];
    const Vec3 area_vector = cross(part.mesh.vertices[t[1]] - a, part.mesh.vertices[t[2]] - a);
    for (const std::uint32_t v : t) {
      if (has_none[v] != 0) sums[v] += area_vector;
    }
  }
  return sums;
}

// The vertices of other tiles that a tile's triangles have, tile by tile.
struct ForeignOf {
  std::uint32_t tile = 0;
  std::vector<std::uint32_t> places;  // in TileMesh::foreign
};

std::vector<ForeignOf> by_owner(const TileSurface& surface, const std::vector<VertexKey>& keys) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> found;
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    found[surface.owner(keys[i])].push_back(i);
  }
  std::vector<ForeignOf> result;
  result.reserve(found.size());
  for (auto& [tile, places] : found) result.push_back({tile, std::move(places)});
  return result;
}

}  // namespace

TileParts::TileParts(PieceStore& store, const TileSurface& surface, std::size_t n_tiles,
                     std::string round)
    : store_(store),
      surface_(surface),
      n_tiles_(n_tiles),
      round_(std::move(round)),
      stays_(n_tiles),
      adopted_(n_tiles),
      borrowed_(n_tiles),
      n_vertices_(n_tiles, 0) {}

std::string TileParts::name_of(const char* what, std::size_t tile) const {
  return what + round_ + "/" + std::to_string(tile);
}

bool TileParts::has(std::size_t tile) const { return store_.has(name_of("parts", tile)); }

void TileParts::find(std::size_t tile, const Context& context) {
  TileMesh part = surface_.mesh(tile);
  const Mesh& mesh = part.mesh;
  const std::vector<std::uint32_t> component = number_components(mesh, context);
  Links links;
  const Vec3& origin = surface_.frame().origin;
  for (const Triangle& t : mesh.faces) {
    const std::uint32_t which = component[t[0]];
    if (which >= links.components.size()) links.components.resize(which + 1);
    Component& own = links.components[which];
    const Vec3 a = mesh.vertices[t[0]] - origin, b = mesh.vertices[t[1]] - origin;
    const Vec3 c = mesh.vertices[t[2]] - origin;
    const Vec3 twice = cross(b - a, c - a);
    const double area = 0.5 * norm(twice);
    own.size.area_vector += 0.5 * twice;
    own.size.area += area;
    own.size.volume += dot(a, cross(b, c)) / 6;
    const auto guessed = [&](std::uint32_t v) { return part.filled[v] != 0; };
    if (!part.filled.empty() && std::any_of(t.begin(), t.end(), guessed)) own.guessed += area;
    ++own.faces;
  }
  links.vertices.assign(links.components.size(), 0);
  for (std::size_t v = 0; v < part.n_own; ++v) {
    if (component[v] != kNone) ++links.vertices[component[v]];
  }
  for (const TileMesh::Shared& one : part.shared) links.shared.push_back(component[one.vertex]);
  links.foreign.assign(component.begin() + static_cast<std::ptrdiff_t>(part.n_own),
                       component.end());
  const std::vector<Lent> all_lent = lent_by(part);
  const std::span<const std::byte> lent[] = {bytes_of(all_lent)};
  store_.write(name_of("lent", tile), lent);
  const std::span<const std::byte> sections[] = {bytes_of(links.shared), bytes_of(links.foreign),
                                                 bytes_of(links.components),
                                                 bytes_of(links.vertices), bytes_of(component)};
  store_.write(name_of("parts", tile), sections);
}

// Returns them in the order of vertices, ascending.
std::vector<TileParts::Lent> TileParts::lent_by(TileMesh& part) const {
  const std::map<std::uint32_t, Vec3> sums =
      sums_without_normal(part, part.n_own, part.mesh.vertices.size());
  std::vector<Lent> lent;
  if (sums.empty()) return lent;
  const std::vector<TileSurface::VertexOfTile> names = surface_.resolve(part.foreign);
  for (const auto& [v, sum] : sums) lent.push_back({names[v - part.n_own], sum});
  return lent;
}

void TileParts::complete_normals(std::size_t tile, TileMesh& part) const {
  std::map<std::uint32_t, Vec3> sums = sums_without_normal(part, 0, part.n_own);
  if (sums.empty()) return;
  for (const Lent& lent : borrowed_[tile]) {
    const auto at = sums.find(lent.vertex.vertex);
    if (at != sums.end()) at->second += lent.area_vector;
  }
  const NormalAttributes normals = normal_attributes(part.mesh);
  for (const auto& [v, sum] : sums) {
    const Vec3 unit = normalized(sum);
    const auto rounded = [](double c) { return static_cast<double>(static_cast<float>(c)); };
    normals.set(v, {rounded(unit.x), rounded(unit.y), rounded(unit.z)});
  }
}

TileParts::Links TileParts::links(std::size_t tile) const {
  const PieceReader piece = store_.open(name_of("parts", tile));
  return {piece.values<std::uint32_t>(0), piece.values<std::uint32_t>(1),
          piece.values<Component>(2), piece.values<std::uint64_t>(3)};
}

std::vector<std::uint32_t> TileParts::components_of_vertices(std::size_t tile) const {
  return store_.open(name_of("parts", tile)).values<std::uint32_t>(4);
}

TileParts::Whole TileParts::join(double least_share) {
  std::vector<Links> all;
  std::vector<std::uint32_t> first(1, 0);  // component of each tile in the whole
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    all.push_back(links(tile));
    first.push_back(first.back() + static_cast<std::uint32_t>(all.back().components.size()));
    n_vertices_[tile] = store_.open(name_of("parts", tile)).size(4) / sizeof(std::uint32_t) -
                        all.back().foreign.size();
  }
  DisjointSets sets(first.back());
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> orphans;
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    const std::vector<VertexKey> keys = surface_.foreign(tile);
    for (const ForeignOf& some : by_owner(surface_, keys)) {
      const std::vector<TileMesh::Shared> shared = surface_.shared(some.tile);
      std::vector<std::uint32_t> of_vertices;  // where a vertex is known by its number only
      for (const std::uint32_t i : some.places) {
        const std::uint32_t here = first[tile] + all[tile].foreign[i];
        std::uint32_t vertex = 0, there = kNone;
        if (keys[i].is_direct()) {
          if (of_vertices.empty()) of_vertices = components_of_vertices(some.tile);
          vertex = keys[i].direct_vertex();
          there = of_vertices[vertex];
        } else {
          const TileMesh::Shared* const found = find_shared(shared, keys[i]);
          vertex = found->vertex;
          there = all[some.tile].shared[static_cast<std::size_t>(found - shared.data())];
        }
        if (there != kNone) {
          sets.unite(here, first[some.tile] + there);
        } else {
          orphans[{some.tile, vertex}].push_back(here);
        }
      }
    }
  }
  for (const auto& [vertex, components] : orphans) {
    for (const std::uint32_t other : components) sets.unite(components.front(), other);
  }
  std::vector<ComponentSize> sizes(first.back());
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    for (std::size_t c = 0; c < all[tile].components.size(); ++c) {
      const ComponentSize& part = all[tile].components[c].size;
      ComponentSize& sum = sizes[sets.find(first[tile] + static_cast<std::uint32_t>(c))];
      sum.area_vector += part.area_vector;
      sum.area += part.area, sum.volume += part.volume;
    }
  }
  const std::vector<char> stay = large_components(sizes, least_share);
  Whole whole;
  for (std::uint32_t c = 0; c < sizes.size(); ++c) {
    if (sets.find(c) != c || !(sizes[c].area > 0)) continue;
    ++whole.components;
    whole.dropped += stay[c] == 0;
  }
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    const PieceReader piece = store_.open(name_of("lent", tile));
    for (const Lent& lent : piece.values<Lent>(0)) {
      borrowed_[lent.vertex.tile].push_back(lent);
    }
  }
  first_vertex_.assign(1, 0), first_triangle_.assign(1, 0);
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    std::uint64_t vertices = 0;
    for (std::size_t c = 0; c < all[tile].components.size(); ++c) {
      stays_[tile].push_back(stay[sets.find(first[tile] + static_cast<std::uint32_t>(c))]);
      if (stays_[tile].back() == 0) continue;
      const Component& part = all[tile].components[c];
      whole.area_vector += part.size.area_vector;
      whole.area += part.size.area, whole.closed_area += part.guessed;
      whole.volume += part.size.volume;
      whole.faces += part.faces;
      vertices += all[tile].vertices[c];
    }
    for (auto it = orphans.lower_bound({static_cast<std::uint32_t>(tile), 0});
         it != orphans.end() && it->first.first == tile; ++it) {
      if (stay[sets.find(it->second.front())] != 0) adopted_[tile].push_back(it->first.second);
    }
    vertices += adopted_[tile].size();
    whole.vertices += vertices;
    first_vertex_.push_back(whole.vertices), first_triangle_.push_back(whole.faces);
  }
  return whole;
}

bool TileParts::keeps_all(std::size_t tile) const {
  return first_vertex_[tile + 1] - first_vertex_[tile] == n_vertices_[tile];
}

std::vector<std::uint8_t> TileParts::kept_vertices(std::size_t tile) const {
  std::vector<std::uint8_t> kept;
  const std::vector<std::uint32_t> component = components_of_vertices(tile);
  kept.reserve(n_vertices_[tile]);
  for (std::size_t v = 0; v < n_vertices_[tile]; ++v) {
    kept.push_back(component[v] != kNone && stays_[tile][component[v]] != 0);
  }
  for (const std::uint32_t v : adopted_[tile]) kept[v] = 1;
  return kept;
}

std::vector<std::uint64_t> TileParts::numbers(std::size_t tile,
                                              const std::vector<std::uint32_t>& vertices) const {
  std::vector<std::uint64_t> result;
  result.reserve(vertices.size());
  if (keeps_all(tile)) {
    for (const std::uint32_t v : vertices) result.push_back(first_vertex_[tile] + v);
    return result;
  }
  const std::vector<std::uint8_t> kept = kept_vertices(tile);
  std::vector<std::uint32_t> before(kept.size());
  std::exclusive_scan(kept.begin(), kept.end(), before.begin(), 0U);
  for (const std::uint32_t v : vertices) result.push_back(first_vertex_[tile] + before[v]);
  return result;
}

TileMesh TileParts::kept_mesh(std::size_t tile) const {
  TileMesh part = surface_.mesh(tile);
  complete_normals(tile, part);
  const std::vector<std::uint32_t> component = components_of_vertices(tile);
  std::erase_if(part.mesh.faces,
                [&](const Triangle& t) { return stays_[tile][component[t[0]]] == 0; });
  return part;
}

PlyPart TileParts::part(std::size_t tile) const {
  TileMesh whole = surface_.mesh(tile);
  std::erase_if(whole.mesh.attributes, [](const Attribute& a) { return a.name == kSupport; });
  complete_normals(tile, whole);
  const std::size_t n = whole.n_own;
  std::vector<std::uint32_t> own(n);
  std::iota(own.begin(), own.end(), 0U);
  std::vector<std::uint64_t> number = numbers(tile, own);
  number.resize(n + whole.foreign.size());
  const std::vector<TileSurface::VertexOfTile> foreign = surface_.resolve(whole.foreign);
  for (const ForeignOf& some : by_owner(surface_, whole.foreign)) {
    std::vector<std::uint32_t> vertices;
    vertices.reserve(some.places.size());
    for (const std::uint32_t i : some.places) vertices.push_back(foreign[i].vertex);
    const std::vector<std::uint64_t> there = numbers(some.tile, vertices);
    for (std::size_t k = 0; k < there.size(); ++k) number[n + some.places[k]] = there[k];
  }
  PlyPart part{.first_vertex = first_vertex_[tile], .first_triangle = first_triangle_[tile]};
  const bool all =
      std::all_of(stays_[tile].begin(), stays_[tile].end(), [](char stays) { return stays != 0; });
  const std::vector<std::uint32_t> component =
      all ? std::vector<std::uint32_t>{} : components_of_vertices(tile);
  part.faces.reserve(whole.mesh.faces.size());
  for (const Triangle& t : whole.mesh.faces) {
    if (!all && stays_[tile][component[t[0]]] == 0) continue;
    part.faces.push_back({number[t[0]], number[t[1]], number[t[2]]});
  }
  part.vertices.vertices = std::move(whole.mesh.vertices);
  part.vertices.attributes = std::move(whole.mesh.attributes);
  const auto cut = [&](auto& values) {
    values.resize(n);
    if (keeps_all(tile)) return;
    const std::vector<std::uint8_t> kept = kept_vertices(tile);
    std::size_t to = 0;
    for (std::size_t v = 0; v < n; ++v) {
      if (kept[v] != 0) values[to++] = values[v];
    }
    values.resize(to);
  };
  cut(part.vertices.vertices);
  for (Attribute& attribute : part.vertices.attributes) cut(attribute.values);
  return part;
}

}  // namespace rholm
