#include "surface/holes/close_grid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "base/parallel.h"
#include "rholm/error.h"
#include "rholm/surface_rules.h"
#include "surface/grid/node_masks.h"
#include "surface/holes/open_cubes.h"

namespace rholm {
namespace {

constexpr std::size_t kGrain = 64;  // blocks per task
// The winding number refutes a sign if it differs from 1/2 by more, to the other side. With 0.15
// fewer horns appear at edges than with 0.2 or 0.3; 0.1 also cuts corners (scripts/constants).
constexpr double kRefuted = 0.15;
// Opening for refuting; coarse, so the winding number may be off by some hundredths. The default
// 2 takes three times as long, and differs at some nodes in a thousand (scripts/constants).
constexpr double kRefutingOpening = 1.3;

bool is_complete(const BlockGrid& grid, const std::vector<char>& fully_known, std::size_t b) {
  return std::all_of(grid.neighbours[b].begin(), grid.neighbours[b].end(),
                     [&](std::int32_t n) { return n != kNoBlock && fully_known[n] != 0; });
}

// State of the search for open cubes.
struct Search {
  std::vector<NodeMasks> masks;
  std::vector<char> fully_known;
  std::vector<Wanted> wanted;       // wanted values of the blocks in `open`
  std::vector<std::uint32_t> open;  // blocks to search in this round, ascending
};

bool is_fully_known(const NodeMasks& masks) {
  return std::all_of(masks.known.begin(), masks.known.end(),
                     [](std::uint64_t word) { return ~word == 0; });
}

// Computes the masks of the blocks that have none yet.
void take_blocks(const BlockGrid& grid, Search& search, const Context& context) {
  const std::size_t before = search.masks.size(), n = grid.n_blocks() - before;
  search.masks.resize(grid.n_blocks());
  search.fully_known.resize(grid.n_blocks());
  parallel_for(n, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
    node_masks(grid.block_values(before + begin), end - begin, &search.masks[before + begin]);
    for (std::size_t b = before + begin; b < before + end; ++b) {
      search.fully_known[b] = is_fully_known(search.masks[b]);
    }
  });
}

Search start_search(const BlockGrid& grid, const GridPart* part, const Context& context) {
  Search search;
  take_blocks(grid, search, context);
  if (part != nullptr) {
    search.open = part->open;
  } else {
    search.open.resize(grid.n_blocks());
    std::iota(search.open.begin(), search.open.end(), 0);
  }
  return search;
}

// Adds everything around the open blocks, if the grid is a part.
void complete(const GridPart* part, BlockGrid& grid, Search& search, Closing& closing,
              const Context& context) {
  if (part == nullptr) return;
  part->complete(grid, search.open);
  take_blocks(grid, search, context);
  closing.seen.insert(closing.seen.end(), search.open.begin(), search.open.end());
}

void sort_seen(Closing& closing) {
  std::sort(closing.seen.begin(), closing.seen.end());
  closing.seen.erase(std::unique(closing.seen.begin(), closing.seen.end()), closing.seen.end());
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

// Adds the missing blocks.
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

// Opens the blocks whose cubes have changed: blocks around new nodes and new blocks.
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
                   const Context& context, const GridPart* part) {
  Closing closing;
  Search search = start_search(grid, part, context);
  while (true) {
    report_progress(context, "", 0);  // may cancel
    complete(part, grid, search, closing, context);
    look_for_wanted(grid, search, context);
    const std::size_t blocks_before = grid.n_blocks();
    const NodeList list = list_nodes(grid, search);
    add_wanted_blocks(grid, search, max_blocks);
    if (list.nodes.empty() && grid.n_blocks() == blocks_before) {
      sort_seen(closing);
      return closing;
    }
    std::vector<double> found(list.places.size());
    if (!found.empty()) values(list.places, found);
    set_nodes(grid, list, found, search);
    open_changed(grid, list, blocks_before, search);
    closing.filled_nodes += list.nodes.size();
    closing.added_blocks += grid.n_blocks() - blocks_before;
    ++closing.rounds;
  }
}

std::vector<std::uint32_t> open_blocks(const BlockGrid& grid, std::size_t n_blocks,
                                       const Context& context) {
  Search search = start_search(grid, nullptr, context);
  search.open.resize(n_blocks);
  look_for_wanted(grid, search, context);
  std::vector<std::uint32_t> open;
  for (std::uint32_t b = 0; b < n_blocks; ++b) {
    if (search.wanted[b].any) open.push_back(b);
  }
  return open;
}

std::size_t clear_refuted(BlockGrid& grid, std::span<const std::uint64_t> doubtful,
                          const WindingNumbers& winding) {
  std::vector<float*> values;
  std::vector<Vec3> places;
  for (std::size_t word = 0; word < doubtful.size(); ++word) {
    for (std::uint64_t bits = doubtful[word]; bits != 0; bits &= bits - 1) {
      const std::size_t node = 64 * (word % 8) + std::countr_zero(bits);
      values.push_back(grid.block_values(word / 8) + node);
      places.push_back(grid.node(word / 8, node));
    }
  }
  const std::vector<double> w = winding(places, kRefutingOpening);
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

NodeValues winding_values(const WindingNumbers& winding, double step) {
  return [winding, step](std::span<const Vec3> x, std::span<double> values) {
    const std::vector<double> w = winding(x, kWindingOpening);
    std::transform(w.begin(), w.end(), values.begin(),
                   [step](double number) { return winding_value(number, step); });
  };
}

EnumNames names_of(HolePolicy) {
  static constexpr std::array kNames = {"fill", "keep"};
  return {"hole policy", kNames};
}

}  // namespace rholm
