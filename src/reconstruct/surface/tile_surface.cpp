#include "reconstruct/surface/tile_surface.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "reconstruct/field/narrow_blocks.h"
#include "rholm/error.h"
#include "shape/normal_attributes.h"
#include "surface/field/cap_field.h"
#include "surface/field/data_support.h"
#include "surface/holes/close_grid.h"
#include "surface/level_set/extract.h"

namespace rholm {
namespace {

// A block's middle lies in the tile, its nodes up to 3.5 steps around, and nodes of the blocks
// beside it 8 more. Vertices lie up to the next node.
constexpr double kAround = 3.5 + 8 + 1.5;
// A triangle's cube starts in a block whose middle lies up to 3.5 steps from there.
constexpr double kWithin = 3.5 + 1 + 1.5;
constexpr std::size_t kTogether = 16;  // blocks of 2 KiB; chosen: a hole's blocks are near
constexpr std::size_t kNoLimit = std::size_t{1} << 40;

std::string name_of(const char* what, std::size_t tile) {
  return std::string(what) + "/" + std::to_string(tile);
}

std::vector<std::uint32_t> all_below(std::size_t n) {
  std::vector<std::uint32_t> all(n);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

// Returns the `places` that are beside one of `own`; both are sorted.
std::vector<BlockCoordinates> beside_some(std::vector<BlockCoordinates> places,
                                          const std::vector<BlockCoordinates>& own) {
  std::sort(places.begin(), places.end(), comes_before);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::erase_if(places, [&](const BlockCoordinates& place) {
    for (int direction = 0; direction < 27; ++direction) {
      if (std::binary_search(own.begin(), own.end(), beside(place, direction), comes_before)) {
        return false;
      }
    }
    return true;
  });
  return places;
}

std::string done_name(const std::string& round) { return "done-" + round; }

}  // namespace

TileSurface::TileSurface(PieceStore& store, const TilePlan& plan, const TileCaps& caps,
                         const TileWinding& winding, const Vec3& origin)
    : store_(store), plan_(plan), caps_(caps), winding_(winding) {
  frame_ = {origin, caps.step(),
            [&plan](const Vec3& x) { return static_cast<std::uint32_t>(plan.tile_of(x)); }};
}

bool TileSurface::has(const char* what, std::size_t tile) const {
  return store_.has(name_of(what, tile));
}

Bounds TileSurface::around(std::size_t tile) const {
  return grown(plan_.cell(tile), kAround * frame_.step);
}

Bounds TileSurface::within(std::size_t tile) const {
  return grown(plan_.cell(tile), -kWithin * frame_.step);
}

NearCaps TileSurface::caps_at(std::span<const BlockCoordinates> blocks) const {
  std::vector<Bounds> boxes;
  for (const BlockCoordinates& b : blocks) {
    const auto corner = [&](double by) {
      return frame_.origin + frame_.step * Vec3{8.0 * b[0] + by, 8.0 * b[1] + by, 8.0 * b[2] + by};
    };
    boxes.push_back({corner(-1), corner(9)});
  }
  return caps_.near(boxes);
}

NearCaps TileSurface::near_caps(std::size_t tile) const {
  const Bounds box = around(tile);
  return caps_.near(std::span(&box, 1));
}

void TileSurface::find_values(std::size_t tile, const Context& context) {
  const NearCaps caps = near_caps(tile);
  const auto self = static_cast<std::uint32_t>(tile);
  const OwnBlocks blocks =
      own_blocks(frame_, self,
                 list_blocks(frame_.origin, frame_.step, caps.discs, kNoLimit, context), context);
  std::vector<BlockCoordinates> all = blocks.own;
  all.insert(all.end(), blocks.around.begin(), blocks.around.end());
  BlockGrid grid = make_block_grid(frame_.origin, frame_.step, std::move(all), context);
  fill(caps, grid, context);
  const std::vector<std::uint32_t> which = open_blocks(grid, blocks.own.size(), context);
  write_near_open(tile, grid, blocks.own.size(), which);
  std::vector<BlockCoordinates> open;
  open.reserve(which.size());
  for (const std::uint32_t b : which) open.push_back(grid.blocks[b]);
  const std::span<const std::byte> places[] = {bytes_of(open)};
  store_.write(name_of("open", tile), places);
  store_.write(name_of("grid", tile), {narrow_blocks(grid, all_below(blocks.own.size()), context)});
  store_.write(name_of("rim", tile),
               {narrow_blocks(grid, border_blocks(frame_, self, blocks.own, context), context)});
}

std::vector<BlockCoordinates> TileSurface::open(std::size_t tile) const {
  return store_.open(name_of("open", tile)).values<BlockCoordinates>(0);
}

std::vector<BlockCoordinates> TileSurface::places(std::size_t tile) const {
  return places_of_narrow(store_.open(name_of("grid", tile)).read(0));
}

void TileSurface::fill(const NearCaps& caps, BlockGrid& grid, const Context& context) const {
  const CapLists lists = list_caps(grid, caps.discs, context);
  const std::vector<std::uint64_t> doubtful =
      fill_grid(caps.atlas, caps.bands, lists, grid, context);
  clear_refuted(grid, doubtful, winding_.numbers(context));
}

// Section 0 has the coordinates; each other section has kTogether blocks.
void TileSurface::write_near_open(std::size_t tile, const BlockGrid& grid, std::size_t n_own,
                                  std::span<const std::uint32_t> open) const {
  std::vector<std::uint8_t> is_near(n_own, 0);
  for (const std::uint32_t b : open) {
    for (const std::int32_t other : grid.neighbours[b]) {
      if (other != kNoBlock && static_cast<std::size_t>(other) < n_own) is_near[other] = 1;
    }
  }
  std::vector<BlockCoordinates> places;
  std::vector<std::vector<std::byte>> sections(1);
  for (std::size_t b = 0; b < n_own; ++b) {
    if (is_near[b] == 0) continue;
    if (places.size() % kTogether == 0) sections.emplace_back();
    places.push_back(grid.blocks[b]);
    const auto values = bytes_of(std::span(grid.block_values(b), BlockGrid::kNodes));
    sections.back().insert(sections.back().end(), values.begin(), values.end());
  }
  const std::span<const std::byte> bytes = bytes_of(places);
  sections.front().assign(bytes.begin(), bytes.end());
  store_.write(name_of("near-open", tile), sections);
}

BlockGrid TileSurface::values_at(std::size_t tile, const std::vector<BlockCoordinates>& blocks,
                                 const Context& context) const {
  BlockGrid grid = make_block_grid(frame_.origin, frame_.step, blocks, context);
  const PieceReader piece = store_.open(name_of("near-open", tile));
  const auto places = piece.values<BlockCoordinates>(0);
  std::vector<BlockCoordinates> others;
  std::size_t section = 0;
  std::vector<float> values;  // of the section
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto at = std::lower_bound(places.begin(), places.end(), blocks[b], comes_before);
    if (at == places.end() || *at != blocks[b]) {
      others.push_back(blocks[b]);
      continue;
    }
    const auto place = static_cast<std::size_t>(at - places.begin());
    if (section != 1 + place / kTogether) {
      section = 1 + place / kTogether;
      values = piece.values<float>(section);
    }
    std::copy_n(values.data() + place % kTogether * BlockGrid::kNodes, BlockGrid::kNodes,
                grid.block_values(b));
  }
  if (others.empty()) return grid;
  BlockGrid rest = make_block_grid(frame_.origin, frame_.step, others, context);
  fill(caps_at(others), rest, context);
  for (std::size_t b = 0; b < rest.n_blocks(); ++b) {
    const auto to = static_cast<std::size_t>(find_block(grid, rest.blocks[b]));
    std::copy_n(rest.block_values(b), BlockGrid::kNodes, grid.block_values(to));
  }
  return grid;
}

void TileSurface::forget_values(std::size_t tile) const {
  store_.remove(name_of("near-open", tile));
}

void TileSurface::write_closed(std::size_t tile, std::span<const ClosedBlock> blocks) {
  const std::span<const std::byte> bytes = bytes_of(blocks);
  store_.write(name_of("closed", tile), {{bytes.begin(), bytes.end()}});
}

// Returns the tile's blocks first, then the blocks around them, with the values that close holes.
BlockGrid TileSurface::whole_grid(std::size_t tile, std::size_t& n_own,
                                  const Context& context) const {
  struct Source {
    std::vector<std::byte> narrow;
    std::vector<ClosedBlock> closed;
  };
  std::vector<Source> sources;
  std::vector<BlockCoordinates> own, around_own;
  for (const std::size_t other : plan_.tiles_meeting(around(tile))) {
    const char* const name = other == tile ? "grid" : "rim";
    sources.push_back({store_.open(name_of(name, other)).read(0), {}});
    if (has("closed", other)) {
      sources.back().closed = store_.open(name_of("closed", other)).values<ClosedBlock>(0);
    }
    std::vector<BlockCoordinates>& places = other == tile ? own : around_own;
    for (const BlockCoordinates& at : places_of_narrow(sources.back().narrow)) {
      places.push_back(at);
    }
    for (const ClosedBlock& block : sources.back().closed) places.push_back(block.at);
  }
  std::sort(own.begin(), own.end(), comes_before);
  own.erase(std::unique(own.begin(), own.end()), own.end());
  n_own = own.size();
  const std::vector<BlockCoordinates> others = beside_some(std::move(around_own), own);
  own.insert(own.end(), others.begin(), others.end());
  BlockGrid grid = make_block_grid(frame_.origin, frame_.step, std::move(own), context);
  for (const Source& source : sources) {
    for_narrow_blocks(source.narrow, frame_.step, [&](const NarrowBlock& block) {
      const std::int32_t b = find_block(grid, block.at);
      if (b == kNoBlock) return;
      std::copy(block.values.begin(), block.values.end(),
                grid.block_values(static_cast<std::size_t>(b)));
    });
    for (const ClosedBlock& block : source.closed) {
      const std::int32_t b = find_block(grid, block.at);
      if (b == kNoBlock) continue;
      if (grid.filled.empty()) grid.filled.assign(8 * grid.n_blocks(), 0);
      std::copy(block.values.begin(), block.values.end(),
                grid.block_values(static_cast<std::size_t>(b)));
      std::copy(block.filled.begin(), block.filled.end(),
                grid.filled.begin() + std::ptrdiff_t{8} * b);
    }
  }
  return grid;
}

TileMesh TileSurface::extract(std::size_t tile, bool support, const Context& context) {
  std::size_t n_own = 0;
  const BlockGrid grid = whole_grid(tile, n_own, context);
  ExtractedSurface surface = extract_part(grid, n_own, context);
  const NearCaps caps = near_caps(tile);
  const CapLists lists = list_caps(grid, caps.discs, context);
  project_vertices(caps.atlas, caps.bands, lists, grid, surface, context);
  if (support) {
    surface.mesh.attributes.push_back(
        {kSupport, ScalarType::kFloat64,
         data_support(caps.atlas, lists, surface, caps.bands, context)});
  }
  const std::vector<BlockCoordinates> own(grid.blocks.begin(),
                                          grid.blocks.begin() + static_cast<std::ptrdiff_t>(n_own));
  TileMesh part = tile_mesh(std::move(surface), grid, n_own,
                            border_blocks(frame_, static_cast<std::uint32_t>(tile), own, context));
  write_mesh(tile, part);
  return part;
}

std::optional<std::uint64_t> TileSurface::begin_round(const std::string& round) {
  if (store_.has(done_name(round))) return take_round(round);
  round_ = round;
  return std::nullopt;
}

void TileSurface::end_round(std::uint64_t result) {
  const std::span<const std::byte> sections[] = {
      bytes_of(std::span<const std::uint64_t>(&result, 1))};
  store_.write(done_name(round_), sections);
  take_round(std::exchange(round_, {}));
}

std::uint64_t TileSurface::take_round(const std::string& round) {
  if (round_ == round) round_.clear();
  if (std::find(rounds_.begin(), rounds_.end(), round) == rounds_.end()) rounds_.push_back(round);
  return store_.open(done_name(round)).values<std::uint64_t>(0).at(0);
}

std::string TileSurface::mesh_name(std::size_t tile) const {
  for (auto round = rounds_.rbegin(); round != rounds_.rend(); ++round) {
    std::string name = name_of(("mesh-" + *round).c_str(), tile);
    if (store_.has(name)) return name;
  }
  return name_of("mesh", tile);
}

void TileSurface::write_mesh(std::size_t tile, TileMesh& part) {
  std::vector<float> normals;
  normals.reserve(3 * part.mesh.vertices.size());
  const NormalAttributes all = normal_attributes(part.mesh);
  for (std::size_t v = 0; v < part.mesh.vertices.size(); ++v) {
    const Vec3 n = all[v];
    for (const double c : {n.x, n.y, n.z}) normals.push_back(static_cast<float>(c));
  }
  const std::vector<std::uint64_t> head = {part.n_own};
  const auto support = std::find_if(part.mesh.attributes.begin(), part.mesh.attributes.end(),
                                    [](const Attribute& a) { return a.name == kSupport; });
  const std::vector<double> none;
  const std::string name =
      round_.empty() ? name_of("mesh", tile) : name_of(("mesh-" + round_).c_str(), tile);
  const std::span<const std::byte> sections[] = {
      bytes_of(head),
      bytes_of(part.shared),
      bytes_of(part.foreign),
      bytes_of(part.mesh.vertices),
      bytes_of(normals),
      bytes_of(part.mesh.faces),
      bytes_of(part.filled),
      bytes_of(support != part.mesh.attributes.end() ? support->values : none)};
  store_.write(name, sections);
}

std::vector<TileSurface::VertexOfTile> TileSurface::names(std::size_t tile,
                                                          const TileMesh& mesh) const {
  std::vector<VertexOfTile> names;
  names.reserve(mesh.mesh.vertices.size());
  for (std::uint32_t v = 0; v < mesh.n_own; ++v) {
    names.push_back({static_cast<std::uint32_t>(tile), v});
  }
  const std::vector<VertexOfTile> foreign = resolve(mesh.foreign);
  names.insert(names.end(), foreign.begin(), foreign.end());
  return names;
}

std::vector<TileSurface::VertexOfTile> TileSurface::lent(std::size_t first, std::size_t end) const {
  std::vector<VertexKey> keys;
  for (std::size_t tile = 0; tile < plan_.n_tiles(); ++tile) {
    if (tile >= first && tile < end) continue;
    for (const VertexKey& key : foreign(tile)) {
      const std::size_t of = owner(key);
      if (of >= first && of < end) keys.push_back(key);
    }
  }
  std::vector<VertexOfTile> names = resolve(keys);
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<TileSurface::VertexOfTile> TileSurface::resolve(
    const std::vector<VertexKey>& keys) const {
  std::vector<VertexOfTile> result(keys.size());
  std::map<std::uint32_t, std::vector<std::size_t>> of_tiles;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i].is_direct()) {
      result[i] = {keys[i].direct_tile(), keys[i].direct_vertex()};
    } else {
      of_tiles[owner(keys[i])].push_back(i);
    }
  }
  for (const auto& [tile, which] : of_tiles) {
    const std::vector<TileMesh::Shared> all = shared(tile);
    for (const std::size_t i : which) result[i] = {tile, find_shared(all, keys[i])->vertex};
  }
  return result;
}

TileMesh TileSurface::mesh(std::size_t tile) const {
  const PieceReader piece = store_.open(mesh_name(tile));
  TileMesh part;
  part.n_own = piece.values<std::uint64_t>(0).at(0);
  part.shared = piece.values<TileMesh::Shared>(1);
  part.foreign = piece.values<VertexKey>(2);
  part.mesh.vertices = piece.values<Vec3>(3);
  const std::vector<float> normals = piece.values<float>(4);
  part.mesh.faces = piece.values<Triangle>(5);
  part.filled = piece.values<std::uint8_t>(6);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    static constexpr const char* kNames[] = {"nx", "ny", "nz"};
    Attribute attribute{kNames[axis], ScalarType::kFloat32, {}};
    attribute.values.reserve(part.mesh.vertices.size());
    for (std::size_t i = axis; i < normals.size(); i += 3) {
      attribute.values.push_back(static_cast<double>(normals[i]));
    }
    part.mesh.attributes.push_back(std::move(attribute));
  }
  std::vector<double> support = piece.values<double>(7);
  if (!support.empty()) {
    part.mesh.attributes.push_back({kSupport, ScalarType::kFloat64, std::move(support)});
  }
  return part;
}

std::size_t TileSurface::n_own(std::size_t tile) const {
  return store_.open(mesh_name(tile)).values<std::uint64_t>(0).at(0);
}

std::uint64_t TileSurface::n_faces(std::size_t tile) const {
  return store_.open(mesh_name(tile)).size(5) / sizeof(Triangle);
}

std::vector<VertexKey> TileSurface::foreign(std::size_t tile) const {
  return store_.open(mesh_name(tile)).values<VertexKey>(2);
}

std::vector<TileMesh::Shared> TileSurface::shared(std::size_t tile) const {
  return store_.open(mesh_name(tile)).values<TileMesh::Shared>(1);
}

}  // namespace rholm
