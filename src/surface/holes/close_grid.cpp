#include "surface/holes/close_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "rholm/error.h"
#include "surface/grid/node_masks.h"
#include "surface/holes/open_cubes.h"

namespace rholm {
namespace {

constexpr std::size_t kGrain = 64;  // blocks
// The winding number refutes a side if it is so far beyond 1/2. Horns at edges are fewer with 0.15
// than with 0.2 or 0.3; with 0.1 corners are cut as well (scripts/constants).
constexpr double kRefuted = 0.15;
// That bound is coarse: the winding number may be off by a few hundredths. 2, the default, takes
// three times as long and refutes the same but for some nodes in a thousand (scripts/constants).
constexpr double kRefutingOpening = 1.3;

bool is_complete(const BlockGrid& grid, const std::vector<char>& fully_known, std::size_t b) {
  return std::all_of(grid.neighbours[b].begin(), grid.neighbours[b].end(),
                     [&](std::int32_t n) { return n != kNoBlock && fully_known[n] != 0; });
}

// The state of the search.
struct Search {
  std::vector<NodeMasks> masks;
  std::vector<char> fully_known;
  std::vector<Wanted> wanted;       // of the blocks in `open`
  std::vector<std::uint32_t> open;  // to look at in this round, ascending
};

bool is_fully_known(const NodeMasks& masks) {
  return std::all_of(masks.known.begin(), masks.known.end(),
                     [](std::uint64_t word) { return ~word == 0; });
}

Search start_search(const BlockGrid& grid, const Context& context) {
  Search search;
  search.masks.resize(grid.n_blocks());
  search.fully_known.resize(grid.n_blocks());
  search.open.resize(grid.n_blocks());
  parallel_for(grid.n_blocks(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    node_masks(grid.block_values(begin), end - begin, &search.masks[begin]);
    for (std::size_t b = begin; b < end; ++b) {
      search.fully_known[b] = is_fully_known(search.masks[b]);
      search.open[b] = static_cast<std::uint32_t>(b);
    }
  });
  return search;
}

void look_for_wanted(const BlockGrid& grid, Search& search, const Context& context) {
  search.wanted.assign(search.open.size(), {});
  parallel_for(search.open.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (is_complete(grid, search.fully_known, search.open[i])) continue;
      search.wanted[i] = find_wanted(grid, search.masks, search.open[i]);
    }
  });
}

// Adds the blocks that are missing.
void add_wanted_blocks(BlockGrid& grid, Search& search, std::size_t max_blocks) {
  std::vector<BlockCoordinates> missing;
  for (std::size_t i = 0; i < search.open.size(); ++i) {
    std::uint32_t bits = search.wanted[i].neighbours;
    for (; bits != 0; bits &= bits - 1) {
      const int n = std::countr_zero(bits);
      const BlockCoordinates& b = grid.blocks[search.open[i]];
      missing.push_back({b[0] + n % 3 - 1, b[1] + n / 3 % 3 - 1, b[2] + n / 9 - 1});
      for (const std::int32_t c : missing.back()) {
        if (std::abs(c) <= kBlockLimit) continue;
        throw Error(ErrorCode::kInvalidInput,
                    "the surface does not close within the grid: take a coarser resolution");
      }
    }
  }
  add_blocks(grid, missing);
  if (grid.n_blocks() > max_blocks) {
    throw Error(
        ErrorCode::kOutOfMemory,
        fmt::format("closing the surface needs more than {} blocks ({:.0f} MiB): take a "
                    "coarser resolution, keep the holes open, or allow more memory",
                    max_blocks, static_cast<double>(block_grid_bytes(max_blocks)) / (1 << 20)));
  }
  search.masks.resize(grid.n_blocks());
  search.fully_known.resize(grid.n_blocks());
}

struct NodeList {
  std::vector<std::uint32_t> blocks;
  std::vector<std::uint16_t> nodes;
  std::vector<Vec3> places;
};

NodeList list_nodes(const BlockGrid& grid, const Search& search) {
  NodeList list;
  for (std::size_t i = 0; i < search.open.size(); ++i) {
    for (std::size_t z = 0; z < 8; ++z) {
      std::uint64_t bits = search.wanted[i].nodes[z];
      for (; bits != 0; bits &= bits - 1) {
        const auto node = static_cast<std::uint16_t>(64 * z + std::countr_zero(bits));
        list.blocks.push_back(search.open[i]);
        list.nodes.push_back(node);
        list.places.push_back(grid.node(search.open[i], node));
      }
    }
  }
  return list;
}

void set_nodes(BlockGrid& grid, const NodeList& list, std::span<const double> values,
               Search& search) {
  if (grid.filled.empty() && !list.nodes.empty()) grid.filled.assign(8 * grid.n_blocks(), 0);
  for (std::size_t i = 0; i < list.nodes.size(); ++i) {
    const std::size_t b = list.blocks[i];
    const std::size_t word = list.nodes[i] >> 6;
    const std::uint64_t bit = std::uint64_t{1} << (list.nodes[i] & 63);
    auto value = static_cast<float>(values[i]);
    if (!std::isfinite(value)) value = static_cast<float>(grid.step);
    grid.block_values(b)[list.nodes[i]] = value;
    grid.filled[8 * b + word] |= bit;
    search.masks[b].known[word] |= bit;
    if (value < 0) search.masks[b].inside[word] |= bit;
    search.fully_known[b] = is_fully_known(search.masks[b]);
  }
}

// The blocks whose cubes have changed: those with new nodes, new blocks, and all around them.
void open_changed(const BlockGrid& grid, const NodeList& list, std::size_t blocks_before,
                  Search& search) {
  std::vector<std::uint32_t> changed;
  const auto add = [&](std::size_t b) {
    for (const std::int32_t n : grid.neighbours[b]) {
      if (n != kNoBlock) changed.push_back(static_cast<std::uint32_t>(n));
    }
  };
  for (std::size_t i = 0; i < list.blocks.size(); ++i) {
    if (i == 0 || list.blocks[i] != list.blocks[i - 1]) add(list.blocks[i]);
  }
  for (std::size_t b = blocks_before; b < grid.n_blocks(); ++b) add(b);
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  search.open = std::move(changed);
}

}  // namespace

Closing close_grid(BlockGrid& grid, const NodeValues& values, std::size_t max_blocks,
                   const Context& context) {
  Closing closing;
  Search search = start_search(grid, context);
  while (true) {
    report_progress(context, "", 0);  // may cancel
    look_for_wanted(grid, search, context);
    const std::size_t blocks_before = grid.n_blocks();
    const NodeList list = list_nodes(grid, search);
    add_wanted_blocks(grid, search, max_blocks);
    if (list.nodes.empty() && grid.n_blocks() == blocks_before) return closing;
    std::vector<double> found(list.places.size());
    if (!found.empty()) values(list.places, found);
    set_nodes(grid, list, found, search);
    open_changed(grid, list, blocks_before, search);
    closing.filled_nodes += list.nodes.size();
    closing.added_blocks += grid.n_blocks() - blocks_before;
    ++closing.rounds;
  }
}

std::size_t clear_refuted(BlockGrid& grid, std::span<const std::uint64_t> doubtful,
                          const WindingTree& tree, const Context& context) {
  std::vector<float*> values;
  std::vector<Vec3> places;
  for (std::size_t word = 0; word < doubtful.size(); ++word) {
    for (std::uint64_t bits = doubtful[word]; bits != 0; bits &= bits - 1) {
      const std::size_t node = 64 * (word % 8) + std::countr_zero(bits);
      values.push_back(grid.block_values(word / 8) + node);
      places.push_back(grid.node(word / 8, node));
    }
  }
  const std::vector<double> w = tree.winding(places, context, kRefutingOpening);
  std::size_t cleared = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double inside = *values[i] < 0 ? w[i] : 1 - w[i];
    if (inside >= 0.5 - kRefuted) continue;
    *values[i] = BlockGrid::kUnknown;
    ++cleared;
  }
  return cleared;
}

double winding_value(double winding, double step) { return (0.5 - winding) * 2 * step; }

NodeValues winding_values(const WindingTree& tree, double step, const Context& context) {
  return [&tree, step, context](std::span<const Vec3> x, std::span<double> values) {
    const std::vector<double> w = tree.winding(x, context);
    std::transform(w.begin(), w.end(), values.begin(),
                   [step](double winding) { return winding_value(winding, step); });
  };
}

}  // namespace rholm
