#include "reconstruct/holes/tile_opening.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "surface/atlas_surface.h"
#include "surface/level_set/mesh_piece.h"
#include "surface/level_set/trim.h"

namespace rholm {
namespace {

// Width of the part gathered around the new borders, in steps of the grid. Edges are up to 1.7
// long, and a border lies within three steps of a sign change of the support.
constexpr double kReach = 6;

std::string name_of(std::size_t tile) { return "gaps/" + std::to_string(tile); }

double area_of(const Mesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.vertices[t[0]];
  return norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a)) / 2;
}

std::size_t n_within(const std::vector<double>& support, const Triangle& t) {
  return static_cast<std::size_t>(
      std::count_if(t.begin(), t.end(), [&](std::uint32_t v) { return support[v] > 0; }));
}

}  // namespace

bool TileOpening::has(std::size_t tile) const { return store_.has(name_of(tile)); }

void TileOpening::find(std::size_t tile) {
  const TileMesh part = surface_.mesh(tile);
  const Mesh& mesh = part.mesh;
  const std::vector<double>& support = *support_of(mesh);
  const auto n = static_cast<std::uint32_t>(support.size());
  DisjointSets sets(n);
  for (const Triangle& t : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (support[a] <= 0 && support[b] <= 0) sets.unite(a, b);
    }
  }
  std::vector<std::uint32_t> of_vertex(n, kNone);
  std::vector<double> areas;
  for (std::uint32_t v = 0; v < n; ++v) {
    if (support[v] > 0) continue;
    std::uint32_t& whole = of_vertex[sets.find(v)];  // the first of its part
    if (whole == kNone) {
      whole = static_cast<std::uint32_t>(areas.size());
      areas.push_back(0);
    }
    of_vertex[v] = whole;
  }
  for (const Triangle& t : mesh.faces) {
    for (const std::uint32_t v : t) {
      if (of_vertex[v] != kNone) areas[of_vertex[v]] += area_of(mesh, t) / 3;
    }
  }
  const std::span<const std::byte> sections[] = {bytes_of(of_vertex), bytes_of(areas)};
  store_.write(name_of(tile), sections);
}

std::vector<std::uint32_t> TileOpening::parts(std::size_t tile) const {
  return store_.open(name_of(tile)).values<std::uint32_t>(0);
}

void TileOpening::join(double least_area) {
  std::vector<std::uint32_t> first(1, 0);
  std::vector<double> areas;
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    const std::vector<double> own = store_.open(name_of(tile)).values<double>(1);
    areas.insert(areas.end(), own.begin(), own.end());
    first.push_back(static_cast<std::uint32_t>(areas.size()));
  }
  DisjointSets sets(areas.size());
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    if (first[tile] == first[tile + 1]) continue;
    const std::vector<std::uint32_t> here = parts(tile);
    std::map<std::uint32_t, std::vector<std::pair<std::uint32_t, std::uint32_t>>> of_tiles;
    const std::vector<VertexKey> keys = surface_.foreign(tile);
    const std::vector<TileSurface::VertexOfTile> names = surface_.resolve(keys);
    const std::size_t n_own = here.size() - names.size();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::uint32_t own = here[n_own + i];
      if (own != kNone) of_tiles[names[i].tile].emplace_back(names[i].vertex, own);
    }
    for (const auto& [other, some] : of_tiles) {
      const std::vector<std::uint32_t> there = parts(other);
      for (const auto& [vertex, own] : some) {
        sets.unite(first[tile] + own, first[other] + there.at(vertex));
      }
    }
  }
  std::vector<double> sums(areas.size(), 0);
  for (std::uint32_t p = 0; p < areas.size(); ++p) sums[sets.find(p)] += areas[p];
  is_kept_.assign(n_tiles_, {});
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    for (std::uint32_t p = first[tile]; p < first[tile + 1]; ++p) {
      is_kept_[tile].push_back(sums[sets.find(p)] < least_area ? 1 : 0);
    }
  }
}

std::vector<double> TileOpening::support(std::size_t tile, const TileMesh& mesh) const {
  std::vector<double> values = *support_of(mesh.mesh);
  if (is_kept_[tile].empty()) return values;
  const std::vector<std::uint32_t> of_vertex = parts(tile);
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (of_vertex[v] != kNone && is_kept_[tile][of_vertex[v]] != 0) values[v] = kBridged;
  }
  return values;
}

void TileOpening::cut(double least_area, const Context& context) {
  if (surface_.begin_round(kOpenRound)) return;
  join(least_area);
  std::vector<Vec3> centers;
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    report_progress(context, "open", static_cast<double>(tile) / static_cast<double>(n_tiles_));
    if (is_kept_[tile].empty()) continue;
    const TileMesh part = surface_.mesh(tile);
    const std::vector<double> values = support(tile, part);
    for (const Triangle& t : part.mesh.faces) {
      const std::size_t n = n_within(values, t);
      if (n == 0 || n == 3) continue;
      for (const std::uint32_t v : t) centers.push_back(part.mesh.vertices[v]);
    }
  }
  const NearPlaces near(centers, kReach * surface_.frame().step);
  GatheredPart part(surface_, 0, n_tiles_, [&](std::size_t, const TileMesh& mesh) {
    const std::vector<Vec3>& places = mesh.mesh.vertices;
    std::vector<std::uint8_t> is_near(places.size()), chosen;
    parallel_for(places.size(), 8192, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) is_near[v] = near.has(places[v]) ? 1 : 0;
    });
    for (const Triangle& t : mesh.mesh.faces) {
      chosen.push_back(is_near[t[0]] & is_near[t[1]] & is_near[t[2]]);
    }
    return chosen;
  });
  TrimmedPart trimmed = trim_part(part.mesh(), gathered_support(part), part.rim());
  GatheredPart::Changed changed{
      .mesh = std::move(trimmed.mesh), .vertices = std::move(trimmed.vertices), .tiles = {}};
  changed.vertices.resize(changed.mesh.vertices.size(), GatheredPart::kNew);
  for (const std::uint32_t t : trimmed.faces) {
    changed.tiles.push_back(part.tile_of_triangle(t));
  }
  part.replace(changed, [&](std::size_t tile, const TileMesh& mesh) {
    std::vector<std::uint8_t> gone;
    const std::vector<double> values = support(tile, mesh);
    gone.reserve(mesh.mesh.faces.size());
    for (const Triangle& t : mesh.mesh.faces) gone.push_back(n_within(values, t) == 0 ? 1 : 0);
    return gone;
  });
  surface_.end_round(0);
}

// Vertices of parts without support that are kept get kBridged.
std::vector<double> TileOpening::gathered_support(const GatheredPart& part) const {
  std::vector<double> values = *support_of(part.mesh());
  std::uint32_t tile = kNone;
  std::vector<std::uint32_t> of_vertex;
  for (std::size_t v = 0; v < values.size(); ++v) {
    const TileSurface::VertexOfTile& name = part.name(v);
    if (is_kept_[name.tile].empty()) continue;
    if (name.tile != tile) {
      tile = name.tile;
      of_vertex = parts(tile);
    }
    const std::uint32_t own = of_vertex.at(name.vertex);
    if (own != kNone && is_kept_[tile][own] != 0) values[v] = kBridged;
  }
  return values;
}

}  // namespace rholm
