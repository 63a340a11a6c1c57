#include "reconstruct/holes/tile_holes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "surface/field/cap_field.h"
#include "surface/field/data_support.h"
#include "surface/holes/close_grid.h"

namespace rholm {
namespace {

bool are_same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

// Edge of a cell in blocks. Open blocks in adjacent cells are in one portion, so a hole is in one
// portion. Chosen: the 25 802 holes of 100 million points of a rough body (bench/tiles/body.py) are
// then 48 portions, of which none meet. Portions that meet are closed again.
constexpr std::int32_t kApart = 4;

using Coordinates = std::array<std::int32_t, 3>;

// Sections of a portion's piece: numbers of a HoleFilling and then numbers of tiles; the blocks
// that were read; the changed blocks of each tile.
constexpr std::size_t kCounts = 3;
constexpr std::size_t kHead = 0, kFetched = 1, kChanged = 2;

Coordinates cell_of(const BlockCoordinates& at, std::int32_t edge) {
  const auto floored = [&](std::int32_t c) { return (c - (c < 0 ? edge - 1 : 0)) / edge; };
  return {floored(at[0]), floored(at[1]), floored(at[2])};
}

template <class Visit>
void for_cells_around(const Coordinates& cell, const Visit& visit) {
  for (std::int32_t x = -1; x <= 1; ++x) {
    for (std::int32_t y = -1; y <= 1; ++y) {
      for (std::int32_t z = -1; z <= 1; ++z)
        visit(Coordinates{cell[0] + x, cell[1] + y, cell[2] + z});
    }
  }
}

// Returns the open blocks of all tiles in portions that are apart. Groups of few blocks form a
// portion together, tile by tile. The result depends on the blocks alone.
std::vector<std::vector<BlockCoordinates>> open_portions(const TileSurface& surface,
                                                         std::size_t n_tiles,
                                                         std::size_t most_open) {
  std::vector<BlockCoordinates> open;  // by tiles
  for (std::size_t tile = 0; tile < n_tiles; ++tile) {
    for (const BlockCoordinates& at : surface.open(tile)) open.push_back(at);
  }
  std::map<Coordinates, std::uint32_t> cells;  // and one of the blocks in each
  DisjointSets sets(open.size());
  for (std::uint32_t i = 0; i < open.size(); ++i) {
    sets.unite(cells.try_emplace(cell_of(open[i], kApart), i).first->second, i);
  }
  for (const auto& [cell, block] : cells) {
    for_cells_around(cell, [&, first = block](const Coordinates& other) {
      const auto at = cells.find(other);
      if (at != cells.end()) sets.unite(first, at->second);
    });
  }
  std::map<std::uint32_t, std::vector<BlockCoordinates>> groups;  // by their first blocks
  std::map<std::uint32_t, std::uint32_t> first;
  for (std::uint32_t i = 0; i < open.size(); ++i) {
    groups[first.try_emplace(sets.find(i), i).first->second].push_back(open[i]);
  }
  std::vector<std::vector<BlockCoordinates>> portions;
  for (const auto& [block, group] : groups) {
    if (portions.empty() || portions.back().size() + group.size() > most_open) {
      portions.emplace_back();
    }
    portions.back().insert(portions.back().end(), group.begin(), group.end());
  }
  for (std::vector<BlockCoordinates>& portion : portions) {
    std::sort(portion.begin(), portion.end(), comes_before);
  }
  return portions;
}

// The grid around one portion, in which its holes are filled.
class HoleGrid {
 public:
  HoleGrid(const TileSurface& surface, const TileWinding& winding, std::size_t n_tiles,
           std::vector<BlockCoordinates> open, const Context& context)
      : surface_(surface),
        winding_(winding),
        n_tiles_(n_tiles),
        context_(context),
        open_(std::move(open)),
        places_(n_tiles) {}

  HoleFilling close(std::size_t max_blocks, const SeenSpace* seen) {
    grid_ = make_block_grid(surface_.frame().origin, surface_.frame().step, {}, context_);
    fetch(open_, grid_);
    GridPart part;
    for (std::uint32_t b = 0; b < grid_.n_blocks(); ++b) part.open.push_back(b);
    part.complete = [this](BlockGrid& grid, std::span<const std::uint32_t> blocks) {
      complete(grid, blocks);
    };
    const HoleFillOptions options{
        .max_blocks = max_blocks,
        .support = [this](std::span<const Vec3> x, std::span<double> out) { support(x, out); },
        .seen = seen,
        .part = &part};
    const HoleFilling filling = fill_holes(
        grid_, [this](std::span<const Hole> holes) { return feet(holes); },
        winding_.numbers(context_), options, context_);
    return filling;
  }

  // Returns the blocks that were read from tiles.
  std::vector<BlockCoordinates> fetched() const {
    std::vector<BlockCoordinates> result;
    result.reserve(fetched_.size());
    for (const std::size_t b : fetched_) result.push_back(grid_.blocks[b]);
    return result;
  }

  // Returns the changed blocks of each tile.
  std::map<std::uint32_t, std::vector<ClosedBlock>> changed() const {
    std::map<std::uint32_t, std::vector<ClosedBlock>> result;
    std::vector<std::uint8_t> was_fetched(grid_.n_blocks(), 0);
    const auto take = [&](std::size_t b) {
      ClosedBlock block{.at = grid_.blocks[b]};
      std::copy(grid_.block_values(b), grid_.block_values(b + 1), block.values.begin());
      if (!grid_.filled.empty()) {
        const auto bits = grid_.filled.begin() + static_cast<std::ptrdiff_t>(8 * b);
        std::copy(bits, bits + 8, block.filled.begin());
      }
      result[surface_.frame().owner(grid_.blocks[b])].push_back(block);
    };
    for (std::size_t i = 0; i < fetched_.size(); ++i) {
      was_fetched[fetched_[i]] = 1;
      const float* const before = original_.data() + i * BlockGrid::kNodes;
      const bool same = std::equal(before, before + BlockGrid::kNodes,
                                   grid_.block_values(fetched_[i]), are_same_bits);
      if (!same || has_filled(fetched_[i])) take(fetched_[i]);
    }
    for (std::size_t b = 0; b < grid_.n_blocks(); ++b) {
      if (was_fetched[b] == 0) take(b);
    }
    return result;
  }

 private:
  // Adds blocks that tiles have, with their values.
  void fetch(const std::vector<BlockCoordinates>& wanted, BlockGrid& grid) {
    std::map<std::uint32_t, std::vector<BlockCoordinates>> of_tiles;
    for (const BlockCoordinates& at : wanted) of_tiles[surface_.frame().owner(at)].push_back(at);
    const std::size_t before = grid.n_blocks();
    add_blocks(grid, wanted);
    for (const auto& [tile, blocks] : of_tiles) {
      const BlockGrid own = surface_.values_at(tile, blocks, context_);
      for (std::size_t b = 0; b < own.n_blocks(); ++b) {
        const std::int32_t to = find_block(grid, own.blocks[b]);
        std::copy(own.block_values(b), own.block_values(b + 1),
                  grid.block_values(static_cast<std::size_t>(to)));
      }
    }
    original_.insert(original_.end(), grid.block_values(before),
                     grid.block_values(grid.n_blocks()));
    for (std::size_t b = before; b < grid.n_blocks(); ++b) fetched_.push_back(b);
  }

  bool exists(const BlockCoordinates& at) {
    const std::uint32_t tile = surface_.frame().owner(at);
    std::optional<std::vector<BlockCoordinates>>& places = places_[tile];
    if (!places) places = surface_.places(tile);
    return std::binary_search(places->begin(), places->end(), at, comes_before);
  }

  void complete(BlockGrid& grid, std::span<const std::uint32_t> blocks) {
    std::vector<BlockCoordinates> wanted;
    for (const std::uint32_t b : blocks) {
      for (int direction = 0; direction < 27; ++direction) {
        if (grid.neighbours[b][direction] != kNoBlock) continue;
        const BlockCoordinates at = beside(grid.blocks[b], direction);
        if (exists(at)) wanted.push_back(at);
      }
    }
    std::sort(wanted.begin(), wanted.end(), comes_before);
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    if (!wanted.empty()) fetch(wanted, grid);
  }

  std::vector<FootPoint> feet(std::span<const Hole> holes) const {
    std::vector<FootPoint> found;
    for (std::size_t tile = 0; tile < n_tiles_; ++tile) {
      const CapExtent& extent = surface_.caps().extent(tile);
      const Bounds box = surface_.caps().extent(tile).reach(surface_.caps().least_band());
      std::vector<const Hole*> near;
      for (const Hole& hole : holes) {
        const double reach = reach_of_feet(hole, grid_.step) + extent.support;
        if (meet(grown({hole.center, hole.center}, reach), box)) near.push_back(&hole);
      }
      if (near.empty()) continue;
      const auto reach_of = [&](const Hole& hole) {
        return reach_of_feet(hole, grid_.step) + extent.support + 8 * grid_.step;
      };
      double edge = 0;  // of cells: only holes in adjacent cells can be near
      for (const Hole* hole : near) edge = std::max(edge, reach_of(*hole));
      const auto cell = [&](const Vec3& p) {
        const Vec3 q = (p - grid_.origin) / edge;
        const auto floored = [](double c) { return static_cast<std::int32_t>(std::floor(c)); };
        return Coordinates{floored(q.x), floored(q.y), floored(q.z)};
      };
      std::map<Coordinates, std::vector<const Hole*>> around;
      for (const Hole* hole : near) {
        for_cells_around(cell(hole->center),
                         [&](const Coordinates& one) { around[one].push_back(hole); });
      }
      for (const CapPatch& patch : surface_.caps().patches(tile)) {
        const auto at = around.find(cell(patch.point));
        if (at == around.end()) continue;
        const auto reaches = [&](const Hole* hole) {
          return norm(patch.point - hole->center) < reach_of(*hole);
        };
        if (std::any_of(at->second.begin(), at->second.end(), reaches)) {
          found.push_back({patch.point, patch.normal, patch.support});
        }
      }
    }
    return found;
  }

  // Returns the blocks whose cubes contain some of the places.
  std::vector<BlockCoordinates> blocks_of(std::span<const Vec3> x,
                                          const std::vector<std::size_t>& which) const {
    std::vector<BlockCoordinates> blocks;
    for (const std::size_t i : which) {
      const Vec3 p = (x[i] - grid_.origin) / (8 * grid_.step);
      const auto cell = [](double c) { return static_cast<std::int32_t>(std::floor(c)); };
      blocks.push_back({cell(p.x), cell(p.y), cell(p.z)});
    }
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
  }

  void support(std::span<const Vec3> x, std::span<double> out) {
    std::map<std::uint32_t, std::vector<std::size_t>> of_tiles;
    for (std::size_t i = 0; i < x.size(); ++i) {
      of_tiles[surface_.frame().tile_of(x[i])].push_back(i);
    }
    for (const auto& [tile, which] : of_tiles) {
      const NearCaps caps = surface_.caps_at(blocks_of(x, which));
      const CapLists lists = list_caps(grid_, caps.discs, context_);
      std::vector<Vec3> places;
      for (const std::size_t i : which) places.push_back(x[i]);
      std::vector<double> found(places.size());
      node_support(caps.atlas, lists, grid_, context_)(places, found);
      for (std::size_t k = 0; k < which.size(); ++k) out[which[k]] = found[k];
    }
  }

  bool has_filled(std::size_t block) const {
    if (grid_.filled.empty()) return false;
    const auto bits = grid_.filled.begin() + static_cast<std::ptrdiff_t>(8 * block);
    return std::any_of(bits, bits + 8, [](std::uint64_t word) { return word != 0; });
  }

  const TileSurface& surface_;
  const TileWinding& winding_;
  std::size_t n_tiles_;
  Context context_;
  std::vector<BlockCoordinates> open_;
  BlockGrid grid_;
  std::vector<std::size_t> fetched_;  // blocks of the grid that tiles have
  std::vector<float> original_;       // their values then
  std::vector<std::optional<std::vector<BlockCoordinates>>> places_;  // of each tile, once asked
};

}  // namespace

TileHoles::TileHoles(PieceStore& store, TileSurface& surface, const TileWinding& winding,
                     std::size_t n_tiles, std::size_t most_open)
    : store_(store), surface_(surface), winding_(winding), n_tiles_(n_tiles) {
  begin_round(open_portions(surface, n_tiles, most_open));
}

void TileHoles::begin_round(std::vector<std::vector<BlockCoordinates>> portions) {
  round_.clear();
  for (std::size_t k = 0; k < portions.size(); ++k) {
    round_.push_back({std::move(portions[k]), fmt::format("filling-{}/{}", n_rounds_, k)});
  }
}

bool TileHoles::is_closed(std::size_t portion) const { return store_.has(round_[portion].name); }

void TileHoles::close(std::size_t portion, std::size_t max_blocks, const SeenSpace* seen,
                      const Context& context) {
  HoleGrid grid(surface_, winding_, n_tiles_, round_[portion].open, context);
  const HoleFilling filling = grid.close(max_blocks, seen);
  std::vector<std::uint64_t> head = {filling.holes, filling.smooth, filling.filled_nodes};
  const std::vector<BlockCoordinates> fetched = grid.fetched();
  const std::map<std::uint32_t, std::vector<ClosedBlock>> changed = grid.changed();
  std::vector<std::span<const std::byte>> sections = {{}, bytes_of(fetched)};
  for (const auto& [tile, blocks] : changed) {
    head.push_back(tile);
    sections.push_back(bytes_of(blocks));
  }
  sections[kHead] = bytes_of(head);
  store_.write(round_[portion].name, sections);
}

// Two portions conflict if one has changed a block that the other has read or changed.
void TileHoles::find_conflicts() {
  const std::string name = fmt::format("again/{}", n_rounds_);
  if (store_.has(name)) return;
  std::vector<const Portion*> all;
  all.reserve(closed_.size() + round_.size());
  for (const Portion& portion : closed_) all.push_back(&portion);
  for (const Portion& portion : round_) all.push_back(&portion);
  std::vector<std::pair<BlockCoordinates, std::uint32_t>> changed, met;
  for (std::uint32_t k = 0; k < all.size(); ++k) {
    const PieceReader piece = store_.open(all[k]->name);
    for (std::size_t section = kChanged; section < piece.n_sections(); ++section) {
      for (const ClosedBlock& block : piece.values<ClosedBlock>(section)) {
        changed.emplace_back(block.at, k);
      }
    }
  }
  std::sort(changed.begin(), changed.end());
  DisjointSets sets(all.size());
  const auto meet = [&](const BlockCoordinates& at, std::uint32_t k) {
    auto it = std::lower_bound(changed.begin(), changed.end(), std::pair{at, std::uint32_t{0}});
    for (; it != changed.end() && it->first == at; ++it) sets.unite(it->second, k);
  };
  for (const auto& [at, k] : changed) meet(at, k);
  for (std::uint32_t k = 0; k < all.size(); ++k) {
    for (const BlockCoordinates& at :
         store_.open(all[k]->name).values<BlockCoordinates>(kFetched)) {
      meet(at, k);
    }
  }
  std::vector<std::uint32_t> joined;  // what each is closed with
  joined.reserve(all.size());
  for (std::uint32_t k = 0; k < all.size(); ++k) joined.push_back(sets.find(k));
  const std::span<const std::byte> sections[] = {bytes_of(joined)};
  store_.write(name, sections);
}

bool TileHoles::take_next_round() {
  const auto joined = store_.open(fmt::format("again/{}", n_rounds_)).values<std::uint32_t>(0);
  std::move(round_.begin(), round_.end(), std::back_inserter(closed_));
  std::map<std::uint32_t, std::vector<std::size_t>> sets;
  for (std::size_t k = 0; k < closed_.size(); ++k) sets[joined.at(k)].push_back(k);
  std::vector<Portion> left;
  std::vector<std::vector<BlockCoordinates>> again;
  for (const auto& [set, members] : sets) {
    if (members.size() == 1) {
      left.push_back(std::move(closed_[members.front()]));
      continue;
    }
    again.emplace_back();
    for (const std::size_t k : members) {
      again.back().insert(again.back().end(), closed_[k].open.begin(), closed_[k].open.end());
      gone_.push_back(closed_[k].name);
    }
    std::sort(again.back().begin(), again.back().end(), comes_before);
  }
  closed_ = std::move(left);
  ++n_rounds_;
  begin_round(std::move(again));
  return !round_.empty();
}

HoleFilling TileHoles::join() {
  HoleFilling all;
  // For each tile, where its changed blocks are: a portion, and a section of its piece.
  std::map<std::uint32_t, std::vector<std::pair<std::size_t, std::size_t>>> places;
  for (std::size_t k = 0; k < closed_.size(); ++k) {
    const auto head = store_.open(closed_[k].name).values<std::uint64_t>(kHead);
    all.holes += head.at(0), all.smooth += head.at(1), all.filled_nodes += head.at(2);
    for (std::size_t i = kCounts; i < head.size(); ++i) {
      places[static_cast<std::uint32_t>(head[i])].emplace_back(k, i - kCounts + kChanged);
    }
  }
  for (const auto& [tile, some] : places) {
    std::vector<ClosedBlock> blocks;
    for (const auto& [k, section] : some) {
      const auto more = store_.open(closed_[k].name).values<ClosedBlock>(section);
      blocks.insert(blocks.end(), more.begin(), more.end());
    }
    surface_.write_closed(tile, blocks);
  }
  return all;
}

void TileHoles::forget() {
  for (const Portion& portion : closed_) store_.remove(portion.name);
  for (const std::string& name : gone_) store_.remove(name);
}

}  // namespace rholm
