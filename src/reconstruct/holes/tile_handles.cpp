#include "reconstruct/holes/tile_handles.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <string>
#include <unordered_map>
#include <utility>

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "reconstruct/surface/tile_gather.h"
#include "shape/normal_attributes.h"
#include "surface/level_set/cut_handles.h"
#include "surface/level_set/mesh_piece.h"
#include "surface/level_set/tight_places.h"

namespace rholm {
namespace {

using VertexOfTile = TileSurface::VertexOfTile;
constexpr std::uint32_t kNone = GatheredPart::kNone;

std::string name_of(std::size_t tile) { return "tight/" + std::to_string(tile); }

constexpr const char* kAll = "all";  // of the tiles
std::string spacings_name(const std::string& of) { return "spacings/" + of; }

void write_spacings(PieceStore& store, const std::string& of,
                    const std::vector<PlaceAndSpacing>& spacings) {
  const std::span<const std::byte> sections[] = {bytes_of(spacings)};
  store.write(spacings_name(of), sections);
}

struct Place {
  std::uint32_t vertex = 0;
  Vec3 at;
};

template <class Name>
struct SharpAt {
  Name name = {};
  SharpVertex vertex = {};
};

struct PlaceHash {
  std::size_t operator()(const std::array<double, 3>& place) const {
    std::size_t hash = 0;
    for (const double c : place) hash = hash * 0x9E3779B97F4A7C15u + std::hash<double>()(c);
    return hash;
  }
};

// The resolutions of tiles' points, where they were foreseen.
class KnownResolutions {
 public:
  KnownResolutions(const GridFrame& frame, double typical, const SpacingsAt& of_tile)
      : resolution_{.typical = typical,
                    .at =
                        [this, &frame](const Vec3& p) {
                          return std::max(known_.at({p.x, p.y, p.z}), frame.step);
                        },
                    .foresee = [this, &frame,
                                &of_tile](const std::vector<Vec3>& p) { add(p, frame, of_tile); }} {
  }
  KnownResolutions(const KnownResolutions&) = delete;
  KnownResolutions& operator=(const KnownResolutions&) = delete;

  const Resolution& resolution() const { return resolution_; }
  std::vector<PlaceAndSpacing> spacings() const {
    std::vector<PlaceAndSpacing> all;
    all.reserve(known_.size());
    for (const auto& [p, spacing] : known_) all.push_back({{p[0], p[1], p[2]}, spacing});
    return all;
  }

 private:
  void add(const std::vector<Vec3>& places, const GridFrame& frame, const SpacingsAt& of_tile) {
    std::map<std::size_t, std::vector<Vec3>> of_tiles;
    for (const Vec3& p : places) {
      if (!known_.contains({p.x, p.y, p.z})) of_tiles[frame.tile_of(p)].push_back(p);
    }
    for (const auto& [tile, some] : of_tiles) {
      const std::vector<double> found = of_tile(tile, some);
      for (std::size_t i = 0; i < some.size(); ++i) {
        known_[{some[i].x, some[i].y, some[i].z}] = found[i];
      }
    }
  }

  std::unordered_map<std::array<double, 3>, double, PlaceHash> known_;
  Resolution resolution_;
};

struct TightPlaces {
  std::vector<VertexOfTile> names;  // ascending
  std::vector<Vec3> at;
};

// The part of the surface around tight places, of all tiles together.
class TightPart {
  using NamedPiecesOfTile = std::vector<std::pair<VertexOfTile, std::uint32_t>>;
  using NamedPieces = std::vector<NamedPiecesOfTile>;

 public:
  TightPart(TileSurface& surface, std::size_t n_tiles, const TightPlaces& places, double reach,
            const Context& context)
      : surface_(surface),
        n_tiles_(n_tiles),
        context_(context),
        near_(places.at, reach),
        part_(
            surface, n_tiles,
            [&](std::size_t tile) { return may_have_some(tile, places.at, reach); },
            [this](std::size_t, const TileMesh& mesh) { return near_triangles(mesh); }) {}

  const Mesh& mesh() const { return part_.mesh(); }

  std::vector<std::uint32_t> vertices_of(const std::vector<VertexOfTile>& names) const {
    std::vector<std::uint32_t> result;
    result.reserve(names.size());
    for (const VertexOfTile& name : names) result.push_back(part_.find(name));
    return result;
  }

  // Returns how the triangles that are not gathered join the gathered part. Reads all tiles.
  JoinedOutside outside() const {
    NamedPieces rims(n_tiles_);
    NamedPiecesOfTile all;
    std::vector<std::uint32_t> first(1, 0);
    for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
      NamedPiecesOfTile links;
      std::uint32_t n = 0;
      find_rest(tile, rims[tile], links, n);
      for (const auto& [name, piece] : links) all.emplace_back(name, first.back() + piece);
      first.push_back(first.back() + n);
    }
    DisjointSets sets(first.back());
    std::sort(all.begin(), all.end());
    for (std::size_t i = 1; i < all.size(); ++i) {
      if (all[i].first == all[i - 1].first) sets.unite(all[i].second, all[i - 1].second);
    }
    JoinedOutside outside{.n = first.back(), .vertices = {}};
    for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
      for (const auto& [name, piece] : rims[tile]) {
        const std::uint32_t v = part_.find(name);
        if (v != kNone) outside.vertices.emplace_back(v, sets.find(first[tile] + piece));
      }
    }
    return outside;
  }

  // Replaces the gathered part by the cut mesh, whose last vertices are copies of others.
  void replace(Mesh cut, const std::vector<std::uint32_t>& copies) {
    const std::size_t n = mesh().vertices.size();
    const auto original = [&](std::uint32_t v) { return v < n ? v : copies[v - n]; };
    GatheredPart::Changed changed{
        .mesh = std::move(cut), .vertices = {}, .tiles = {}, .new_are_filled = true};
    changed.vertices.resize(n);
    std::iota(changed.vertices.begin(), changed.vertices.end(), 0U);
    changed.vertices.resize(changed.mesh.vertices.size(), GatheredPart::kNew);
    for (std::size_t t = 0; t < changed.mesh.faces.size(); ++t) {
      changed.tiles.push_back(t < mesh().faces.size()
                                  ? part_.tile_of_triangle(t)
                                  : part_.name(original(changed.mesh.faces[t][0])).tile);
    }
    part_.replace(changed);
  }

 private:
  bool may_have_some(std::size_t tile, const std::vector<Vec3>& places, double reach) const {
    // NearPlaces has places within less than twice the reach along each axis.
    const Bounds box = grown(surface_.around(tile), 2 * reach);
    return std::any_of(places.begin(), places.end(),
                       [&](const Vec3& place) { return is_within(box, place); });
  }

  std::vector<std::uint8_t> near_vertices(const Mesh& mesh) const {
    std::vector<std::uint8_t> is_near(mesh.vertices.size());
    parallel_for(is_near.size(), 8192, context_, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) is_near[v] = near_.has(mesh.vertices[v]) ? 1 : 0;
    });
    return is_near;
  }

  std::vector<std::uint8_t> near_triangles(const TileMesh& part) const {
    const std::vector<std::uint8_t> is_near = near_vertices(part.mesh);
    std::vector<std::uint8_t> chosen;
    chosen.reserve(part.mesh.faces.size());
    for (const Triangle& c : part.mesh.faces) {
      chosen.push_back(is_near[c[0]] & is_near[c[1]] & is_near[c[2]]);
    }
    return chosen;
  }

  // Returns the names of some vertices of a tile's mesh: the tile of each and its number there.
  std::vector<VertexOfTile> names_of(std::size_t tile, const TileMesh& part,
                                     const std::vector<std::uint32_t>& vertices) const {
    std::vector<VertexOfTile> names(vertices.size());
    std::vector<VertexKey> keys;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      names[i] = {static_cast<std::uint32_t>(tile), vertices[i]};
      if (vertices[i] < part.n_own) continue;
      keys.push_back(part.foreign[vertices[i] - part.n_own]);
      places.push_back(i);
    }
    const std::vector<VertexOfTile> foreign = surface_.resolve(keys);
    for (std::size_t k = 0; k < places.size(); ++k) names[places[k]] = foreign[k];
    return names;
  }

  // Finds the connected pieces of a tile's other triangles, and the vertices that they share with
  // the gathered part and with other tiles.
  void find_rest(std::size_t tile, NamedPiecesOfTile& rim, NamedPiecesOfTile& links,
                 std::uint32_t& n_pieces) const {
    const TileMesh part = surface_.mesh(tile);
    const std::vector<std::uint8_t> is_near = near_vertices(part.mesh);
    const std::vector<Triangle>& triangles = part.mesh.faces;
    const std::size_t n = part.mesh.vertices.size();
    const auto is_in_rest = [&](const Triangle& c) {
      return (is_near[c[0]] & is_near[c[1]] & is_near[c[2]]) == 0;
    };
    DisjointSets sets(n);
    for (const Triangle& c : triangles) {
      if (!is_in_rest(c)) continue;
      sets.unite(c[0], c[1]);
      sets.unite(c[1], c[2]);
    }
    std::vector<std::uint32_t> piece(n, kNone);
    std::vector<std::uint8_t> in_rest(n, 0), is_shared(n, 0);
    for (const Triangle& c : triangles) {
      if (!is_in_rest(c)) continue;
      std::uint32_t& own = piece[sets.find(c[0])];
      if (own == kNone) own = n_pieces++;
      for (const std::uint32_t v : c) in_rest[v] = 1;
    }
    for (const TileMesh::Shared& one : part.shared) is_shared[one.vertex] = 1;
    std::vector<std::uint32_t> wanted;
    for (std::uint32_t v = 0; v < n; ++v) {
      if (in_rest[v] == 0) continue;
      if (is_near[v] != 0 || v >= part.n_own || is_shared[v] != 0) wanted.push_back(v);
    }
    const std::vector<VertexOfTile> names = names_of(tile, part, wanted);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const std::uint32_t v = wanted[i], own = piece[sets.find(v)];
      if (is_near[v] != 0) rim.emplace_back(names[i], own);
      if (v >= part.n_own || is_shared[v] != 0) links.emplace_back(names[i], own);
    }
  }

  TileSurface& surface_;
  std::size_t n_tiles_;
  Context context_;
  NearPlaces near_;
  GatheredPart part_;
};

}  // namespace

bool TileHandles::has(std::size_t tile) const { return store_.has(name_of(tile)); }

// Returns the box in which the tile alone decides whether a place is cut.
Bounds TileHandles::decided(std::size_t tile) const {
  return grown(surface_.within(tile), -reach_of_cuts(typical_));
}

void TileHandles::find(std::size_t tile, TileMesh part, const Context& context) {
  const double length = length_of_tight_places(typical_);
  const NormalAttributes normals = normal_attributes(part.mesh);
  const std::vector<std::uint32_t> all =
      sharp_vertices(part.mesh, normals, length, part.n_own, context);
  std::vector<SharpVertex> sharp;
  sharp.reserve(all.size());
  for (const std::uint32_t v : all) sharp.push_back({part.mesh.vertices[v], normals[v]});
  std::vector<std::uint32_t> places;
  const Bounds inner = decided(tile);
  for (const std::uint32_t i : turning_around(sharp, length)) {
    if (all[i] < part.n_own && is_within(inner, sharp[i].at)) places.push_back(all[i]);
  }
  const KnownResolutions known(surface_.frame(), typical_, spacings_);
  std::vector<Place> kept;
  for (const std::uint32_t v : places_to_cut(part.mesh, places, known.resolution(), context)) {
    kept.push_back({v, part.mesh.vertices[v]});
  }
  write_spacings(store_, std::to_string(tile), known.spacings());
  // Also stores the sharp vertices with which turning_around() decides the other places.
  const Bounds unseen = grown(inner, -length);
  std::vector<SharpAt<std::uint32_t>> own;
  std::vector<SharpAt<VertexKey>> foreign;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i] >= part.n_own) {
      foreign.push_back({part.foreign[all[i] - part.n_own], sharp[i]});
    } else if (!is_within(unseen, sharp[i].at)) {
      own.push_back({all[i], sharp[i]});
    }
  }
  const std::span<const std::byte> sections[] = {bytes_of(kept), bytes_of(own), bytes_of(foreign)};
  store_.write(name_of(tile), sections);
}

namespace {

// Places to cut that all tiles have found, and the sharp vertices near the borders of tiles.
class FoundPlaces {
 public:
  void add(std::uint32_t tile, const PieceReader& piece, const TileSurface& surface) {
    for (const auto& [v, at] : piece.values<Place>(0))
      places_.emplace_back(VertexOfTile{tile, v}, at);
    for (const auto& [v, vertex] : piece.values<SharpAt<std::uint32_t>>(1)) {
      sharp_.push_back({{tile, v}, vertex});
    }
    std::vector<VertexKey> keys;
    const auto foreign = piece.values<SharpAt<VertexKey>>(2);
    keys.reserve(foreign.size());
    for (const auto& one : foreign) keys.push_back(one.name);
    const std::vector<VertexOfTile> names = surface.resolve(keys);
    for (std::size_t i = 0; i < names.size(); ++i) sharp_.push_back({names[i], foreign[i].vertex});
  }

  // `is_decided` returns true for places that a tile has decided alone.
  TightPlaces join(double length,
                   const std::function<bool(std::uint32_t tile, const Vec3& at)>& is_decided) {
    const auto by_name = [](const auto& a, const auto& b) { return a.name < b.name; };
    const auto same = [](const auto& a, const auto& b) { return a.name == b.name; };
    std::sort(sharp_.begin(), sharp_.end(), by_name);
    sharp_.erase(std::unique(sharp_.begin(), sharp_.end(), same), sharp_.end());
    std::vector<SharpVertex> vertices;
    vertices.reserve(sharp_.size());
    for (const SharpAt<VertexOfTile>& one : sharp_) vertices.push_back(one.vertex);
    for (const std::uint32_t i : turning_around(vertices, length)) {
      const SharpAt<VertexOfTile>& one = sharp_[i];
      if (!is_decided(one.name.tile, one.vertex.at)) places_.emplace_back(one.name, one.vertex.at);
    }
    std::sort(places_.begin(), places_.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    TightPlaces all;
    for (const auto& [name, at] : places_) {
      all.names.push_back(name);
      all.at.push_back(at);
    }
    return all;
  }

 private:
  std::vector<std::pair<VertexOfTile, Vec3>> places_;
  std::vector<SharpAt<VertexOfTile>> sharp_;
};

}  // namespace

std::size_t TileHandles::cut(const Context& context) {
  if (const auto known = surface_.begin_round(kCutRound)) return *known;
  FoundPlaces found;
  std::vector<Bounds> inner;
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    found.add(static_cast<std::uint32_t>(tile), store_.open(name_of(tile)), surface_);
    inner.push_back(decided(tile));
  }
  const TightPlaces places =
      found.join(length_of_tight_places(typical_),
                 [&](std::uint32_t tile, const Vec3& at) { return is_within(inner[tile], at); });
  CutHandles cut;
  if (!places.names.empty()) {
    TightPart part(surface_, n_tiles_, places, reach_of_cuts(typical_), context);
    const KnownResolutions known(surface_.frame(), typical_, spacings_);
    Mesh mesh = part.mesh();
    cut = cut_handles_at(
        mesh, part.vertices_of(places.names), known.resolution(), [&] { return part.outside(); },
        context);
    if (cut.handles > 0) part.replace(std::move(mesh), cut.copies);
    write_spacings(store_, kAll, known.spacings());
  }
  surface_.end_round(cut.handles);
  return cut.handles;
}

std::vector<PlaceAndSpacing> TileHandles::spacings() const {
  std::vector<PlaceAndSpacing> all;
  const auto append = [&](const std::string& of) {
    if (!store_.has(spacings_name(of))) return;
    const auto some = store_.open(spacings_name(of)).values<PlaceAndSpacing>(0);
    all.insert(all.end(), some.begin(), some.end());
  };
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) append(std::to_string(tile));
  append(kAll);
  return all;
}

}  // namespace rholm
