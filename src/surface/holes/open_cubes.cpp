#include "surface/holes/open_cubes.h"

#include <array>
#include <bit>

namespace rholm {
namespace {

// Rows of ten nodes along x around a block: bit 1 + x of row [z + 1][y + 1], -1 <= x, y, z <= 8.
using PaddedBits = std::array<std::array<std::uint16_t, 10>, 10>;

// Place p = 0 ... 9 of a padded row lies in block side_of(p) (0 is the one below), node node_of(p).
constexpr int side_of(int p) { return p == 0 ? 0 : p == 9 ? 2 : 1; }
constexpr int node_of(int p) { return (p + 7) & 7; }

PaddedBits padded_bits(const BlockGrid& grid, const std::vector<NodeMasks>& masks, std::size_t b,
                       NodeBits NodeMasks::*which) {
  PaddedBits rows;
  for (int z = 0; z < 10; ++z) {
    for (int y = 0; y < 10; ++y) {
      const auto row = [&](int side) -> unsigned {
        const std::int32_t other = grid.neighbours[b][side + 3 * side_of(y) + 9 * side_of(z)];
        if (other == kNoBlock) return 0;
        return (masks[other].*which)[node_of(z)] >> 8 * node_of(y) & 0xff;
      };
      rows[z][y] = static_cast<std::uint16_t>(row(0) >> 7 | row(1) << 1 | (row(2) & 1) << 9);
    }
  }
  return rows;
}

// Cubes with a corner in a block, by lowest nodes -1 ... 7: bit 1 + x of [z + 1][y + 1].
using PaddedCubes = std::array<std::array<std::uint16_t, 9>, 9>;

// Returns the cubes that have at least one of the nodes as a corner.
PaddedCubes cubes_with(const PaddedBits& nodes) {
  PaddedCubes cubes;
  for (int z = 0; z < 9; ++z) {
    for (int y = 0; y < 9; ++y) {
      const unsigned any = nodes[z][y] | nodes[z][y + 1] | nodes[z + 1][y] | nodes[z + 1][y + 1];
      cubes[z][y] = static_cast<std::uint16_t>((any | any >> 1) & 0x1ff);
    }
  }
  return cubes;
}

PaddedBits without(const PaddedBits& all, const PaddedBits& some) {
  PaddedBits result;
  for (int z = 0; z < 10; ++z) {
    for (int y = 0; y < 10; ++y) result[z][y] = all[z][y] & ~some[z][y];
  }
  return result;
}

constexpr PaddedBits all_nodes() {
  PaddedBits all{};
  for (auto& slice : all) slice.fill(0x3ff);
  return all;
}

// Records that the node at padded place (x, y, z) needs a value.
void note(const BlockGrid& grid, std::size_t b, int x, int y, int z, Wanted& wanted) {
  const int neighbour = side_of(x) + 3 * side_of(y) + 9 * side_of(z);
  wanted.any = true;
  if (neighbour == 13) {
    wanted.nodes[node_of(z)] |= std::uint64_t{1} << (node_of(x) + 8 * node_of(y));
  } else if (grid.neighbours[b][neighbour] == kNoBlock) {
    wanted.neighbours |= 1U << neighbour;
  }
}

// Slice of 10 x 10 nodes around a block: 12 rows of 16 bits in three words, bit 1 + x. Their
// y are 0 ... 3; 4 ... 7; 8, unused, unused, -1. The next row, cyclically, is the next y.
using Slice = std::array<std::uint64_t, 3>;

// Widens the low four bytes of a word to 16 bits each.
std::uint64_t widen(std::uint64_t bytes) {
  bytes = (bytes | bytes << 16) & 0x0000ffff0000ffffULL;
  return (bytes | bytes << 8) & 0x00ff00ff00ff00ffULL;
}

// Returns four rows: eight bits of `middle`, and the bit on either side from its neighbours.
std::uint64_t four_rows(std::uint64_t left, std::uint64_t middle, std::uint64_t right) {
  constexpr std::uint64_t kBytes = 0xffffffffULL;
  return widen(left >> 7 & kFirstColumn & kBytes) | widen(middle & kBytes) << 1 |
         widen(right & kFirstColumn & kBytes) << 9;
}

// Returns slice z; around[n] are the bits of neighbour n (13 is the block itself).
Slice slice_of(const std::array<const NodeBits*, 27>& around, int z) {
  const int side = 9 * side_of(z);
  const auto word = [&](int n) { return (*around[side + n])[node_of(z)]; };
  const std::uint64_t after = four_rows(word(6), word(7), word(8)) & 0xffff;
  const std::uint64_t before = four_rows(word(0) >> 56, word(1) >> 56, word(2) >> 56);
  return {four_rows(word(3), word(4), word(5)),
          four_rows(word(3) >> 32, word(4) >> 32, word(5) >> 32), after | before << 48};
}

// Returns the squares of a slice, by lowest node, with at least one of the nodes.
Slice squares_with(const Slice& nodes) {
  Slice pairs;
  for (int w = 0; w < 3; ++w) pairs[w] = nodes[w] | nodes[w] >> 1;
  Slice squares;
  for (int w = 0; w < 3; ++w) squares[w] = pairs[w] | pairs[w] >> 16 | pairs[(w + 1) % 3] << 48;
  return squares;
}

// Squares that contain an inside, an outside, or an unknown node.
struct Squares {
  Slice inside, outside, unknown;
};

Squares squares_of(const std::array<const NodeBits*, 27>& known,
                   const std::array<const NodeBits*, 27>& inside, int z) {
  const Slice known_nodes = slice_of(known, z);
  const Slice inside_nodes = slice_of(inside, z);
  Slice outside_nodes;
  Slice unknown_nodes;
  for (int w = 0; w < 3; ++w) {
    outside_nodes[w] = known_nodes[w] & ~inside_nodes[w];
    unknown_nodes[w] = ~known_nodes[w];
  }
  return {squares_with(inside_nodes), squares_with(outside_nodes), squares_with(unknown_nodes)};
}

// Returns true if a cube of the block is open; nearly all blocks have none.
bool has_open_cube(const BlockGrid& grid, const std::vector<NodeMasks>& masks, std::size_t b) {
  constexpr NodeBits kNoBits = {};
  // Selects squares with x = -1 ... 7, y = -1 ... 7.
  constexpr Slice kValid = {0x01ff01ff01ff01ffULL, 0x01ff01ff01ff01ffULL, 0x01ff000000000000ULL};
  std::array<const NodeBits*, 27> known;
  std::array<const NodeBits*, 27> inside;
  for (int n = 0; n < 27; ++n) {
    const std::int32_t other = grid.neighbours[b][n];
    known[n] = other == kNoBlock ? &kNoBits : &masks[other].known;
    inside[n] = other == kNoBlock ? &kNoBits : &masks[other].inside;
  }
  Squares last = squares_of(known, inside, 0);
  std::uint64_t found = 0;
  for (int z = 1; z < 10; ++z) {
    const Squares next = squares_of(known, inside, z);
    for (int w = 0; w < 3; ++w) {
      found |= (last.inside[w] | next.inside[w]) & (last.outside[w] | next.outside[w]) &
               (last.unknown[w] | next.unknown[w]) & kValid[w];
    }
    last = next;
  }
  return found != 0;
}

}  // namespace

// Returns the unknown corners of cubes around the block that have both signs.
Wanted find_wanted(const BlockGrid& grid, const std::vector<NodeMasks>& masks, std::size_t b) {
  if (!has_open_cube(grid, masks, b)) return {};
  const PaddedBits known = padded_bits(grid, masks, b, &NodeMasks::known);
  const PaddedBits inside = padded_bits(grid, masks, b, &NodeMasks::inside);
  const PaddedBits unknown = without(all_nodes(), known);
  const PaddedCubes some_inside = cubes_with(inside);
  const PaddedCubes some_outside = cubes_with(without(known, inside));
  const PaddedCubes some_unknown = cubes_with(unknown);
  Wanted wanted;
  for (int z = 0; z < 9; ++z) {
    for (int y = 0; y < 9; ++y) {
      const unsigned cubes = some_inside[z][y] & some_outside[z][y] & some_unknown[z][y];
      if (cubes == 0) continue;
      for (int o = 0; o < 4; ++o) {
        const int row_y = y + (o & 1);
        const int row_z = z + (o >> 1);
        unsigned nodes = (cubes | cubes << 1) & unknown[row_z][row_y];
        for (; nodes != 0; nodes &= nodes - 1) {
          note(grid, b, std::countr_zero(nodes), row_y, row_z, wanted);
        }
      }
    }
  }
  return wanted;
}

}  // namespace rholm
