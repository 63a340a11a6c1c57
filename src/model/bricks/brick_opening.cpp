#include "model/bricks/brick_opening.h"

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

// In steps of the grid, of what is gathered around the new borders: edges are up to 1.7 long, and a
// border lies within three of where the sign of the support changes.
constexpr double kReach = 6;

std::string name_of(std::size_t brick) { return "gaps/" + std::to_string(brick); }

double area_of(const Mesh& mesh, const Triangle& t) {
  const Vec3& a = mesh.vertices[t[0]];
  return norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a)) / 2;
}

std::size_t n_within(const std::vector<double>& support, const Triangle& t) {
  return static_cast<std::size_t>(
      std::count_if(t.begin(), t.end(), [&](std::uint32_t v) { return support[v] > 0; }));
}

}  // namespace

bool BrickOpening::has(std::size_t brick) const { return store_.has(name_of(brick)); }

void BrickOpening::find(std::size_t brick) {
  const BrickMesh part = surface_.mesh(brick);
  const Mesh& mesh = part.mesh;
  const std::vector<double>& support = *support_of(mesh);
  const auto n = static_cast<std::uint32_t>(support.size());
  DisjointSets sets(n);
  for (const Triangle& t : mesh.triangles) {
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
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      if (of_vertex[v] != kNone) areas[of_vertex[v]] += area_of(mesh, t) / 3;
    }
  }
  const std::span<const std::byte> sections[] = {bytes_of(of_vertex), bytes_of(areas)};
  store_.write(name_of(brick), sections);
}

std::vector<std::uint32_t> BrickOpening::parts(std::size_t brick) const {
  return store_.open(name_of(brick)).values<std::uint32_t>(0);
}

void BrickOpening::join(double least_area) {
  std::vector<std::uint32_t> first(1, 0);
  std::vector<double> areas;
  for (std::size_t brick = 0; brick < n_bricks_; ++brick) {
    const std::vector<double> own = store_.open(name_of(brick)).values<double>(1);
    areas.insert(areas.end(), own.begin(), own.end());
    first.push_back(static_cast<std::uint32_t>(areas.size()));
  }
  DisjointSets sets(areas.size());
  for (std::size_t brick = 0; brick < n_bricks_; ++brick) {
    if (first[brick] == first[brick + 1]) continue;
    const std::vector<std::uint32_t> here = parts(brick);
    std::map<std::uint32_t, std::vector<std::pair<std::uint32_t, std::uint32_t>>> of_bricks;
    const std::vector<VertexKey> keys = surface_.foreign(brick);
    const std::vector<BrickSurface::VertexOfBrick> names = surface_.resolve(keys);
    const std::size_t n_own = here.size() - names.size();
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::uint32_t own = here[n_own + i];
      if (own != kNone) of_bricks[names[i].brick].emplace_back(names[i].vertex, own);
    }
    for (const auto& [other, some] : of_bricks) {
      const std::vector<std::uint32_t> there = parts(other);
      for (const auto& [vertex, own] : some) {
        sets.unite(first[brick] + own, first[other] + there.at(vertex));
      }
    }
  }
  std::vector<double> sums(areas.size(), 0);
  for (std::uint32_t p = 0; p < areas.size(); ++p) sums[sets.find(p)] += areas[p];
  is_kept_.assign(n_bricks_, {});
  for (std::size_t brick = 0; brick < n_bricks_; ++brick) {
    for (std::uint32_t p = first[brick]; p < first[brick + 1]; ++p) {
      is_kept_[brick].push_back(sums[sets.find(p)] < least_area ? 1 : 0);
    }
  }
}

std::vector<double> BrickOpening::support(std::size_t brick, const BrickMesh& mesh) const {
  std::vector<double> values = *support_of(mesh.mesh);
  if (is_kept_[brick].empty()) return values;
  const std::vector<std::uint32_t> of_vertex = parts(brick);
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (of_vertex[v] != kNone && is_kept_[brick][of_vertex[v]] != 0) values[v] = kBridged;
  }
  return values;
}

void BrickOpening::cut(double least_area, const Context& context) {
  if (surface_.begin_round(kOpenRound)) return;
  join(least_area);
  std::vector<Vec3> centers;
  for (std::size_t brick = 0; brick < n_bricks_; ++brick) {
    report_progress(context, "open", static_cast<double>(brick) / static_cast<double>(n_bricks_));
    if (is_kept_[brick].empty()) continue;
    const BrickMesh part = surface_.mesh(brick);
    const std::vector<double> values = support(brick, part);
    for (const Triangle& t : part.mesh.triangles) {
      const std::size_t n = n_within(values, t);
      if (n == 0 || n == 3) continue;
      for (const std::uint32_t v : t) centers.push_back(part.mesh.vertices[v]);
    }
  }
  const NearPlaces near(centers, kReach * surface_.frame().step);
  GatheredPart part(surface_, 0, n_bricks_, [&](std::size_t, const BrickMesh& mesh) {
    const std::vector<Vec3>& places = mesh.mesh.vertices;
    std::vector<std::uint8_t> is_near(places.size()), chosen;
    parallel_for(places.size(), 8192, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) is_near[v] = near.has(places[v]) ? 1 : 0;
    });
    for (const Triangle& t : mesh.mesh.triangles) {
      chosen.push_back(is_near[t[0]] & is_near[t[1]] & is_near[t[2]]);
    }
    return chosen;
  });
  TrimmedPart trimmed = trim_part(part.mesh(), gathered_support(part), part.rim());
  GatheredPart::Changed changed{
      .mesh = std::move(trimmed.mesh), .vertices = std::move(trimmed.vertices), .bricks = {}};
  changed.vertices.resize(changed.mesh.vertices.size(), GatheredPart::kNew);
  for (const std::uint32_t t : trimmed.triangles) {
    changed.bricks.push_back(part.brick_of_triangle(t));
  }
  part.replace(changed, [&](std::size_t brick, const BrickMesh& mesh) {
    std::vector<std::uint8_t> gone;
    const std::vector<double> values = support(brick, mesh);
    gone.reserve(mesh.mesh.triangles.size());
    for (const Triangle& t : mesh.mesh.triangles) gone.push_back(n_within(values, t) == 0 ? 1 : 0);
    return gone;
  });
  surface_.end_round(0);
}

// Of the gathered vertices, with what is kept of parts without.
std::vector<double> BrickOpening::gathered_support(const GatheredPart& part) const {
  std::vector<double> values = *support_of(part.mesh());
  std::uint32_t brick = kNone;
  std::vector<std::uint32_t> of_vertex;
  for (std::size_t v = 0; v < values.size(); ++v) {
    const BrickSurface::VertexOfBrick& name = part.name(v);
    if (is_kept_[name.brick].empty()) continue;
    if (name.brick != brick) {
      brick = name.brick;
      of_vertex = parts(brick);
    }
    const std::uint32_t own = of_vertex.at(name.vertex);
    if (own != kNone && is_kept_[brick][own] != 0) values[v] = kBridged;
  }
  return values;
}

}  // namespace rholm
