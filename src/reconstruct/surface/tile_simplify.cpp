#include "reconstruct/surface/tile_simplify.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/parallel.h"

namespace rholm {
namespace {

// Rings of triangles around shared vertices that strips have (chosen): triangles that were
// simplified against locked vertices are simplified again.
constexpr std::size_t kRings = 3;
// Curves end where a tile has this part of its share of the wanted triangles.
constexpr double kLeastOfShare = 0.125;

std::string name_of(const char* what, std::size_t tile) {
  return std::string(what) + "/" + std::to_string(tile);
}

std::string planes_name(std::size_t level, std::size_t number) {
  return "planes-" + std::to_string(level) + "/" + std::to_string(number);
}

// Progress would run from the beginning for each tile.
Context without_progress(Context context) {
  context.progress = {};
  return context;
}

// Returns the tile's mesh with these triangles instead, which have some of its vertices. Its own
// vertices keep their numbers, because other tiles know them.
TileMesh with_triangles(const TileMesh& before, std::vector<Triangle> triangles) {
  TileMesh part;
  part.n_own = before.n_own;
  part.shared = before.shared;
  std::vector<std::uint32_t> moved(before.foreign.size(), 0);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) {
      if (v >= part.n_own) moved[v - part.n_own] = 1;
    }
  }
  std::vector<std::uint32_t> kept(part.n_own);
  std::iota(kept.begin(), kept.end(), 0U);
  for (std::uint32_t i = 0; i < moved.size(); ++i) {
    if (moved[i] == 0) continue;
    moved[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(static_cast<std::uint32_t>(part.n_own + i));
    part.foreign.push_back(before.foreign[i]);
  }
  for (Triangle& t : triangles) {
    for (std::uint32_t& v : t) {
      if (v >= part.n_own) v = moved[v - part.n_own];
    }
  }
  part.mesh.faces = std::move(triangles);
  for (const std::uint32_t v : kept) part.mesh.vertices.push_back(before.mesh.vertices[v]);
  for (const Attribute& attribute : before.mesh.attributes) {
    Attribute own{attribute.name, attribute.type, {}};
    for (const std::uint32_t v : kept) own.values.push_back(attribute.values[v]);
    part.mesh.attributes.push_back(std::move(own));
  }
  return part;
}

// Returns the number of triangles left at a cost, between the steps of a curve.
double triangles_at(const std::vector<SimplifiedPart::Step>& curve, double cost) {
  const auto after =
      std::upper_bound(curve.begin(), curve.end(), cost,
                       [](double c, const SimplifiedPart::Step& step) { return c < step.cost; });
  const SimplifiedPart::Step& low = after == curve.begin() ? curve.front() : *(after - 1);
  const auto least = static_cast<double>(low.faces);
  if (after == curve.end() || after == curve.begin()) return least;
  const double part = (cost - low.cost) / (after->cost - low.cost);
  return least + part * (static_cast<double>(after->faces) - least);
}

}  // namespace

TileSimplify::TileSimplify(PieceStore& store, TileSurface& surface, const TileParts& parts,
                           std::size_t n_tiles, const TileSimplifyOptions& options)
    : store_(store), surface_(surface), parts_(parts), n_tiles_(n_tiles), options_(options) {
  const auto share =
      static_cast<std::uint64_t>(options.stops.share * static_cast<double>(options.faces));
  most_ = std::max<std::uint64_t>(options.stops.faces, share);
  find_shared(1);
}

std::size_t TileSimplify::group_of(std::size_t level) const {
  std::size_t tiles = 1;
  for (std::size_t k = 0; k < level && tiles < n_tiles_; ++k) tiles *= options_.group;
  return tiles;
}

void TileSimplify::find_shared(std::size_t group) {
  shared_.clear();
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    for (const Name& name : surface_.resolve(surface_.foreign(tile))) {
      if (name.tile / group != tile / group) shared_.push_back(name);
    }
  }
  std::sort(shared_.begin(), shared_.end());
  shared_.erase(std::unique(shared_.begin(), shared_.end()), shared_.end());
}

bool TileSimplify::is_shared(const Name& name) const {
  return std::binary_search(shared_.begin(), shared_.end(), name);
}

SimplifyPart TileSimplify::whole_part(std::size_t tile, const TileMesh& mesh) const {
  SimplifyPart part{.points = mesh.mesh.vertices,
                    .faces = mesh.mesh.faces,
                    .kinds = std::vector<PartVertex>(mesh.mesh.vertices.size(), PartVertex::kFree),
                    .quadrics = {},
                    .unit = options_.step};
  const std::vector<Name> names = surface_.names(tile, mesh);
  for (std::size_t v = 0; v < names.size(); ++v) {
    if (is_shared(names[v])) part.kinds[v] = PartVertex::kLocked;
  }
  return part;
}

bool TileSimplify::has_curve(std::size_t tile) const { return store_.has(name_of("curve", tile)); }

void TileSimplify::find_curve(std::size_t tile, const Context& context) {
  const TileMesh mesh = parts_.kept_mesh(tile);
  const auto n = static_cast<double>(mesh.mesh.faces.size());
  const double share = n * static_cast<double>(most_) / static_cast<double>(options_.faces);
  SimplifiedPart found =
      simplify_part(whole_part(tile, mesh), static_cast<std::size_t>(kLeastOfShare * share),
                    options_.stops.max_error, without_progress(context));
  found.steps.insert(found.steps.begin(), {0, mesh.mesh.faces.size()});
  const std::span<const std::byte> sections[] = {bytes_of(found.steps)};
  store_.write(name_of("curve", tile), sections);
}

void TileSimplify::choose() {
  if (!wants_curves()) {
    targets_.assign(n_tiles_, most_);
    return;
  }
  std::vector<std::vector<SimplifiedPart::Step>> curves;
  double low = 0, high = 0;  // costs
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
    curves.push_back(store_.open(name_of("curve", tile)).values<SimplifiedPart::Step>(0));
    high = std::max(high, curves.back().back().cost);
  }
  // Locked vertices stay now and are too many, with two triangles each. A line of them is thinned
  // later, by the root of the surface's thinning.
  const double thinned =
      std::sqrt(static_cast<double>(most_) / static_cast<double>(options_.faces));
  const double wanted = static_cast<double>(most_) +
                        2 * static_cast<double>(shared_.size()) * std::max(0.0, 1 - thinned);
  const auto sum_at = [&](double cost) {
    double sum = 0;
    for (const auto& curve : curves) sum += triangles_at(curve, cost);
    return sum;
  };
  for (int k = 0; k < 60; ++k) {  // halves down to rounding
    const double middle = 0.5 * (low + high);
    (sum_at(middle) > wanted ? low : high) = middle;
  }
  targets_.clear();
  for (const auto& curve : curves) {
    targets_.push_back(static_cast<std::uint64_t>(triangles_at(curve, high)));
  }
}

std::size_t TileSimplify::n_levels() const {
  std::size_t levels = 1;
  while (group_of(levels - 1) < n_tiles_) ++levels;
  return levels;
}

void TileSimplify::begin(std::size_t level) {
  level_ = level;
  round_ = "simple-" + std::to_string(level);
  find_shared(group_of(level > 0 ? level - 1 : 0));
  const std::uint64_t now = count_triangles();
  to_go_ = now > most_ ? now - most_ : 0;
  is_done_ = surface_.begin_round(round_).has_value();
}

std::size_t TileSimplify::n_groups() const {
  const std::size_t tiles = group_of(level_);
  return (n_tiles_ + tiles - 1) / tiles;
}

bool TileSimplify::has(std::size_t group) const { return store_.has(planes_name(level_, group)); }

void TileSimplify::work(std::size_t group, const Context& context) {
  if (level_ == 0) {
    simplify(group, context);
  } else {
    join(group, context);
  }
}

void TileSimplify::end() {
  if (!is_done_) surface_.end_round(0);
}

void TileSimplify::take() { surface_.take_round(round_); }

void TileSimplify::simplify(std::size_t tile, const Context& context) {
  const TileMesh before = parts_.kept_mesh(tile);
  SimplifiedPart found = simplify_part(whole_part(tile, before), targets_[tile],
                                       options_.stops.max_error, without_progress(context));
  // Keeps the planes of the vertices in strips, by their names in the mesh before.
  TileMesh chosen = before;
  chosen.mesh.faces = found.faces;
  const std::vector<std::uint8_t> is_near = near_shared(tile, chosen);
  std::vector<std::uint8_t> used(before.mesh.vertices.size(), 0);
  for (std::size_t t = 0; t < is_near.size(); ++t) {
    if (is_near[t] == 0) continue;
    for (const std::uint32_t v : found.faces[t]) used[v] = 1;
  }
  const std::vector<Name> names = surface_.names(tile, before);
  Planes planes;
  for (std::size_t i = 0; i < found.vertices.size(); ++i) {
    const std::uint32_t v = found.vertices[i];
    if (used[v] != 0) planes.emplace_back(names[v], found.quadrics[i]);
  }
  TileMesh after = with_triangles(before, std::move(found.faces));
  surface_.write_mesh(tile, after);
  write_planes(0, tile, planes, found.error);
}

// Returns 1 for triangles within some rings of a vertex that groups share.
std::vector<std::uint8_t> TileSimplify::near_shared(std::size_t tile, const TileMesh& mesh) const {
  const std::vector<Name> names = surface_.names(tile, mesh);
  std::vector<std::uint8_t> ring(names.size(), kRings);  // and more
  for (std::size_t v = 0; v < names.size(); ++v) {
    if (is_shared(names[v])) ring[v] = 0;
  }
  const auto least = [&](const Triangle& t) {
    return std::min({ring[t[0]], ring[t[1]], ring[t[2]]});
  };
  for (std::uint8_t r = 0; r + 1U < kRings; ++r) {
    for (const Triangle& t : mesh.mesh.faces) {
      if (least(t) != r) continue;
      for (const std::uint32_t v : t) ring[v] = std::min<std::uint8_t>(ring[v], r + 1);
    }
  }
  std::vector<std::uint8_t> chosen;
  chosen.reserve(mesh.mesh.faces.size());
  for (const Triangle& t : mesh.mesh.faces) chosen.push_back(least(t) < kRings ? 1 : 0);
  return chosen;
}

void TileSimplify::write_planes(std::size_t level, std::size_t number, const Planes& planes,
                                double error) const {
  std::vector<Name> names;
  std::vector<PlaneQuadric> quadrics;
  for (const auto& [name, quadric] : planes) names.push_back(name), quadrics.push_back(quadric);
  const std::span<const std::byte> sections[] = {bytes_of(names), bytes_of(quadrics),
                                                 bytes_of(std::span<const double>(&error, 1))};
  store_.write(planes_name(level, number), sections);
}

TileSimplify::Planes TileSimplify::read_planes(std::size_t level, std::size_t first,
                                               std::size_t end) const {
  Planes all;
  for (std::size_t number = first; number < end; ++number) {
    const PieceReader piece = store_.open(planes_name(level, number));
    const std::vector<Name> names = piece.values<Name>(0);
    const std::vector<PlaneQuadric> quadrics = piece.values<PlaneQuadric>(1);
    for (std::size_t i = 0; i < names.size(); ++i) all.emplace_back(names[i], quadrics.at(i));
  }
  // Equal names stay in the order of the pieces.
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  Planes sums;
  for (const auto& [name, quadric] : all) {
    if (sums.empty() || sums.back().first != name) {
      sums.emplace_back(name, quadric);
    } else {
      sums.back().second.add(quadric);
    }
  }
  return sums;
}

std::uint64_t TileSimplify::count_triangles() const {
  std::uint64_t n = 0;
  for (std::size_t tile = 0; tile < n_tiles_; ++tile) n += surface_.n_faces(tile);
  return n;
}

void TileSimplify::join(std::size_t group, const Context& context) {
  const std::size_t tiles = group_of(level_), before = group_of(level_ - 1);
  const std::size_t first = group * tiles, end = std::min(n_tiles_, first + tiles);
  GatheredPart strips(surface_, first, end, [&](std::size_t tile, const TileMesh& mesh) {
    return near_shared(tile, mesh);
  });
  const Mesh& mesh = strips.mesh();
  const std::size_t n = mesh.vertices.size(), n_faces = mesh.faces.size();
  SimplifyPart part{.points = mesh.vertices,
                    .faces = mesh.faces,
                    .kinds = std::vector<PartVertex>(n, PartVertex::kFree),
                    .quadrics = std::vector<PlaneQuadric>(n),
                    .unit = options_.step};
  const Planes planes = read_planes(level_ - 1, first / before, (end + before - 1) / before);
  std::uint64_t unlocked = 0;
  for (std::size_t v = 0; v < n; ++v) {
    const auto at =
        std::lower_bound(planes.begin(), planes.end(), strips.name(v),
                         [](const auto& a, const Name& name) { return a.first < name; });
    if (at != planes.end() && at->first == strips.name(v)) part.quadrics[v] = at->second;
    if (strips.rim()[v] != 0) {
      part.kinds[v] = PartVertex::kLocked;
    } else if (is_shared(strips.name(v))) {
      part.kinds[v] = PartVertex::kUnlocked;
      ++unlocked;
    }
  }
  // Removes a share of the excess: the share of the shared vertices that are now in the group.
  const bool is_last = end - first == n_tiles_;
  const auto own = static_cast<std::uint64_t>(
      is_last ? static_cast<double>(to_go_)
              : static_cast<double>(to_go_) * static_cast<double>(unlocked) /
                    static_cast<double>(std::max<std::size_t>(1, shared_.size())));
  std::size_t wanted = own < n_faces ? n_faces - own : 0;
  if (most_ == 0) wanted = 0;
  const SimplifiedPart found =
      simplify_part(std::move(part), wanted, options_.stops.max_error, without_progress(context));
  Planes left;
  GatheredPart::Changed changed;
  std::vector<std::uint32_t> place(n, 0);
  for (const Attribute& a : mesh.attributes) {
    changed.mesh.attributes.push_back({a.name, a.type, {}});
  }
  for (std::size_t i = 0; i < found.vertices.size(); ++i) {
    const std::uint32_t v = found.vertices[i];
    place[v] = static_cast<std::uint32_t>(i);
    left.emplace_back(strips.name(v), found.quadrics[i]);
    changed.mesh.vertices.push_back(mesh.vertices[v]);
    for (std::size_t k = 0; k < mesh.attributes.size(); ++k) {
      changed.mesh.attributes[k].values.push_back(mesh.attributes[k].values[v]);
    }
  }
  changed.vertices = found.vertices;
  for (std::size_t t = 0; t < found.faces.size(); ++t) {
    const Triangle& c = found.faces[t];
    changed.mesh.faces.push_back({place[c[0]], place[c[1]], place[c[2]]});
    changed.tiles.push_back(strips.tile_of_triangle(found.origins[t]));
  }
  strips.replace(changed);
  write_planes(level_, group, left, found.error);
}

double TileSimplify::error() const {
  double most = 0;
  for (std::size_t level = 0;; ++level) {
    const std::size_t group = group_of(level);
    for (std::size_t number = 0; number * group < n_tiles_; ++number) {
      const PieceReader piece = store_.open(planes_name(level, number));
      most = std::max(most, piece.values<double>(2).at(0));
    }
    if (group >= n_tiles_) return most;
  }
}

}  // namespace rholm
