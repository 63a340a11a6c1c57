#include "reconstruct/surface/tile_gather.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

namespace rholm {
namespace {

using VertexOfTile = TileSurface::VertexOfTile;
// A vertex with all its attributes.
struct Row {
  Vec3 at;
  std::vector<double> values;
};

Row row_of(const Mesh& mesh, std::size_t v) {
  Row row{mesh.vertices[v], {}};
  for (const Attribute& attribute : mesh.attributes) row.values.push_back(attribute.values[v]);
  return row;
}

void append(const Row& row, Mesh& mesh) {
  mesh.vertices.push_back(row.at);
  for (std::size_t k = 0; k < mesh.attributes.size(); ++k) {
    mesh.attributes[k].values.push_back(row.values[k]);
  }
}

// Appends a vertex of another mesh with the same attributes.
void append(const Mesh& from, std::size_t v, Mesh& mesh) {
  mesh.vertices.push_back(from.vertices[v]);
  for (std::size_t k = 0; k < mesh.attributes.size(); ++k) {
    mesh.attributes[k].values.push_back(from.attributes[k].values[v]);
  }
}

void copy_row(const Mesh& from, std::size_t v, Mesh& mesh, std::size_t to) {
  mesh.vertices[to] = from.vertices[v];
  for (std::size_t k = 0; k < mesh.attributes.size(); ++k) {
    mesh.attributes[k].values[to] = from.attributes[k].values[v];
  }
}

void resize(Mesh& mesh, std::size_t n) {
  mesh.vertices.resize(n);
  for (Attribute& attribute : mesh.attributes) attribute.values.resize(n);
}

}  // namespace

// Changed triangles of one tile.
struct GatheredPart::NewTriangles {
  std::vector<std::array<Corner, 3>> faces;
  std::vector<std::uint32_t> vertices;  // new ones that are the tile's own, of the changed mesh
};

// Vertices of triangles that are not gathered.
struct GatheredPart::Left {
  std::vector<std::vector<bool>> own;  // vertices of each tile, in its own triangles
  std::vector<VertexOfTile> foreign;   // vertices in triangles of other tiles
};

GatheredPart::GatheredPart(TileSurface& surface, std::size_t first, std::size_t end,
                           const Choose& choose)
    : surface_(surface), first_(first), end_(end) {
  Left left;
  gather([](std::size_t) { return true; }, choose, &left);
  for (const VertexOfTile& name : surface.lent(first, end)) left.foreign.push_back(name);
  find_rim(left.own, left.foreign);
}

GatheredPart::GatheredPart(TileSurface& surface, std::size_t n_tiles, const ChooseTile& choose_tile,
                           const Choose& choose)
    : surface_(surface), first_(0), end_(n_tiles) {
  gather(choose_tile, choose, nullptr);
}

void GatheredPart::gather(const ChooseTile& choose_tile, const Choose& choose, Left* left) {
  Mesh all;  // vertices of all tiles
  std::vector<VertexOfTile> all_names;
  std::vector<Triangle> corners;
  for (std::size_t tile = first_; tile < end_; ++tile) {
    if (left != nullptr) left->own.emplace_back();
    if (!choose_tile(tile)) continue;
    const TileMesh part = surface_.mesh(tile);
    const Mesh& mesh = part.mesh;
    const std::vector<std::uint8_t> chosen = choose(tile, part);
    const std::vector<VertexOfTile> names = surface_.names(tile, part);
    std::vector<std::uint32_t> place(names.size(), kNone);
    std::vector<bool> is_left(names.size(), false);
    if (all.attributes.empty() && !mesh.vertices.empty()) {
      for (const Attribute& a : mesh.attributes) all.attributes.push_back({a.name, a.type, {}});
    }
    for (std::uint32_t t = 0; t < mesh.faces.size(); ++t) {
      Triangle c = mesh.faces[t];
      if (chosen[t] == 0) {
        is_left[c[0]] = is_left[c[1]] = is_left[c[2]] = true;
        continue;
      }
      for (std::uint32_t& v : c) {
        if (place[v] == kNone) {
          place[v] = static_cast<std::uint32_t>(all_names.size());
          all_names.push_back(names[v]);
          append(mesh, v, all);
        }
        v = place[v];
      }
      corners.push_back(c);
      triangles_.push_back({static_cast<std::uint32_t>(tile), t});
    }
    if (left == nullptr) continue;
    for (std::size_t v = part.n_own; v < names.size(); ++v) {
      if (is_left[v]) left->foreign.push_back(names[v]);
    }
    is_left.resize(part.n_own);
    left->own.back() = std::move(is_left);
  }
  std::vector<std::uint32_t> order(all_names.size()), index(order.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return all_names[a] < all_names[b]; });
  for (const Attribute& a : all.attributes) mesh_.attributes.push_back({a.name, a.type, {}});
  for (const std::uint32_t v : order) {
    if (names_.empty() || names_.back() != all_names[v]) {
      names_.push_back(all_names[v]);
      append(all, v, mesh_);
    }
    index[v] = static_cast<std::uint32_t>(names_.size() - 1);
  }
  for (const Triangle& c : corners) {
    mesh_.faces.push_back({index[c[0]], index[c[1]], index[c[2]]});
  }
}

void GatheredPart::find_rim(const std::vector<std::vector<bool>>& left_own,
                            const std::vector<VertexOfTile>& left_foreign) {
  rim_.assign(names_.size(), 0);
  for (std::size_t v = 0; v < names_.size(); ++v) {
    const std::size_t tile = names_[v].tile;
    const bool is_here = tile >= first_ && tile < end_;
    rim_[v] = !is_here || left_own[tile - first_][names_[v].vertex] ? 1 : 0;
  }
  for (const VertexOfTile& name : left_foreign) {
    const std::uint32_t v = find(name);
    if (v != kNone) rim_[v] = 1;
  }
}

std::uint32_t GatheredPart::find(const VertexOfTile& name) const {
  const auto at = std::lower_bound(names_.begin(), names_.end(), name);
  if (at == names_.end() || *at != name) return kNone;
  return static_cast<std::uint32_t>(at - names_.begin());
}

std::vector<std::uint8_t> GatheredPart::changed_tiles(const Changed& changed) const {
  std::vector<std::uint8_t> is_new(changed.mesh.vertices.size(), 1);  // or not as it was
  for (std::size_t v = 0; v < is_new.size(); ++v) {
    if (changed.vertices[v] == kNew) continue;
    const std::size_t before = changed.vertices[v];
    is_new[v] = changed.mesh.vertices[v] == mesh_.vertices[before] ? 0 : 1;
    for (std::size_t k = 0; k < mesh_.attributes.size(); ++k) {
      if (changed.mesh.attributes[k].values[v] != mesh_.attributes[k].values[before]) is_new[v] = 1;
    }
  }
  // Gathered triangles are in the order of tiles; changed ones are in order within each tile.
  std::vector<std::size_t> next(end_ - first_ + 1, 0);
  for (const TriangleOfTile& t : triangles_) ++next[t.tile - first_ + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  const std::vector<std::size_t> end(next.begin() + 1, next.end());
  std::vector<std::uint8_t> differs(end_ - first_, 0);
  for (std::size_t t = 0; t < changed.mesh.faces.size(); ++t) {
    const std::size_t tile = changed.tiles[t] - first_;
    if (next[tile] == end[tile]) {
      differs[tile] = 1;
      continue;
    }
    const Triangle &now = changed.mesh.faces[t], &before = mesh_.faces[next[tile]++];
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_new[now[k]] != 0 || changed.vertices[now[k]] != before[k]) differs[tile] = 1;
    }
  }
  for (std::size_t tile = 0; tile < end.size(); ++tile) {
    if (next[tile] != end[tile]) differs[tile] = 1;
  }
  return differs;
}

void GatheredPart::replace(const Changed& changed, const Choose& drop) {
  // New vertices belong to the tile of their first triangle.
  std::vector<NewTriangles> fresh(end_ - first_);
  std::vector<std::uint32_t> owner(changed.mesh.vertices.size(), kNone), place(owner);
  for (std::size_t t = 0; t < changed.mesh.faces.size(); ++t) {
    const std::uint32_t tile = changed.tiles[t];
    for (const std::uint32_t v : changed.mesh.faces[t]) {
      if (changed.vertices[v] != kNew || owner[v] != kNone) continue;
      owner[v] = tile;
      std::vector<std::uint32_t>& own = fresh[tile - first_].vertices;
      place[v] = static_cast<std::uint32_t>(own.size());
      own.push_back(v);
    }
  }
  std::vector<std::uint32_t> n_own(fresh.size(), 0);
  for (std::size_t k = 0; k < fresh.size(); ++k) {
    if (!fresh[k].vertices.empty()) {
      n_own[k] = static_cast<std::uint32_t>(surface_.n_own(first_ + k));
    }
  }
  const auto name_of = [&](std::uint32_t v) -> VertexOfTile {
    if (changed.vertices[v] != kNew) return names_[changed.vertices[v]];
    return {owner[v], n_own[owner[v] - first_] + place[v]};
  };
  for (std::size_t t = 0; t < changed.mesh.faces.size(); ++t) {
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = changed.mesh.faces[t][k];
      corners[k] = {name_of(v), v};
    }
    fresh[changed.tiles[t] - first_].faces.push_back(corners);
  }
  const std::vector<std::uint8_t> differs = changed_tiles(changed);
  for (std::size_t tile = first_; tile < end_; ++tile) {
    std::vector<std::uint8_t> dropped;
    if (drop) dropped = drop(tile, surface_.mesh(tile));
    const bool changes = differs[tile - first_] != 0 ||
                         std::find(dropped.begin(), dropped.end(), 1) != dropped.end();
    if (changes) rewrite(tile, changed, fresh[tile - first_], dropped);
  }
}

void GatheredPart::rewrite(std::size_t tile, const Changed& changed, const NewTriangles& fresh,
                           const std::vector<std::uint8_t>& dropped) {
  TileMesh part = surface_.mesh(tile);
  Mesh& mesh = part.mesh;
  const std::size_t n_before = part.n_own;
  std::vector<std::uint8_t> stays(mesh.faces.size(), 1);
  for (const TriangleOfTile& t : triangles_) {
    if (t.tile == tile) stays[t.triangle] = 0;
  }
  for (std::size_t t = 0; t < dropped.size(); ++t) {
    if (dropped[t] != 0) stays[t] = 0;
  }
  // Vertices of other tiles in the new mesh, with their keys from before if there were any.
  struct Foreign {
    VertexKey key;
    Row row;
  };
  std::map<VertexOfTile, Foreign> known, used;
  const std::vector<VertexOfTile> names = surface_.names(tile, part);
  for (std::size_t i = 0; i < part.foreign.size(); ++i) {
    known[names[n_before + i]] = {part.foreign[i], row_of(mesh, n_before + i)};
  }
  std::vector<std::array<VertexOfTile, 3>> corners;
  for (std::size_t t = 0; t < stays.size(); ++t) {
    if (stays[t] == 0) continue;
    const Triangle& c = mesh.faces[t];
    corners.push_back({names[c[0]], names[c[1]], names[c[2]]});
    for (const VertexOfTile& name : corners.back()) {
      if (name.tile != tile) used[name] = known.at(name);
    }
  }
  for (const auto& triangle : fresh.faces) {
    corners.push_back({triangle[0].name, triangle[1].name, triangle[2].name});
    for (const Corner& corner : triangle) {
      const VertexOfTile& name = corner.name;
      if (name.tile == tile) {
        if (name.vertex < n_before) copy_row(changed.mesh, corner.vertex, mesh, name.vertex);
        continue;
      }
      const auto before = known.find(name);
      used[name] = {
          before != known.end() ? before->second.key : VertexKey::direct(name.tile, name.vertex),
          row_of(changed.mesh, corner.vertex)};
    }
  }
  std::vector<std::pair<VertexKey, VertexOfTile>> order;
  order.reserve(used.size());
  for (const auto& [name, foreign] : used) order.emplace_back(foreign.key, name);
  std::sort(order.begin(), order.end());
  resize(mesh, n_before);
  for (const std::uint32_t v : fresh.vertices) append(row_of(changed.mesh, v), mesh);
  part.n_own = mesh.vertices.size();
  part.foreign.clear();
  std::map<VertexOfTile, std::uint32_t> number;
  for (const auto& [key, name] : order) {
    number[name] = static_cast<std::uint32_t>(mesh.vertices.size());
    part.foreign.push_back(key);
    append(used.at(name).row, mesh);
  }
  if (!part.filled.empty() || changed.new_are_filled) {
    part.filled.resize(names.size());
    std::vector<std::uint8_t> filled(mesh.vertices.size(), 0);
    std::copy_n(part.filled.begin(), n_before, filled.begin());
    std::fill_n(filled.begin() + static_cast<std::ptrdiff_t>(n_before), fresh.vertices.size(),
                changed.new_are_filled ? 1 : 0);
    for (std::size_t i = n_before; i < names.size(); ++i) {
      const auto at = number.find(names[i]);
      if (at != number.end()) filled[at->second] = part.filled[i];
    }
    for (const auto& triangle : fresh.faces) {
      for (const Corner& corner : triangle) {
        if (corner.name.tile == tile || changed.vertices[corner.vertex] != kNew) continue;
        filled[number.at(corner.name)] = changed.new_are_filled ? 1 : 0;
      }
    }
    part.filled = std::move(filled);
  }
  mesh.faces.clear();
  for (const auto& c : corners) {
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = c[k].tile == tile ? c[k].vertex : number.at(c[k]);
    mesh.faces.push_back(t);
  }
  surface_.write_mesh(tile, part);
}

}  // namespace rholm
