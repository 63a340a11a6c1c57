#include "surface/level_set/extract.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <functional>

#include "base/large_vector.h"
#include "base/parallel.h"
#include "rholm/error.h"
#include "surface/grid/node_masks.h"
#include "surface/level_set/marching_cubes_table.h"

namespace rholm {
namespace {

// A vertex keeps this distance, in steps, from the nodes; otherwise triangles around a
// node shrink to nothing as its value approaches zero. The rule moves a vertex by at most
// a hundredth of a step, and bounds the ratio of a triangle's sides by about 1 : 100.
constexpr double kClosest = 0.01;

// Number of blocks per task: at least about 10 us of work.
constexpr std::size_t kGrain = 64;

// Facts about a block that are computed before output is written. Bits are as in
// NodeBits: a cube has the bit of its lowest node, an edge the bit of its lower end.
struct BlockSurface {
  NodeMasks nodes;
  NodeBits cubes = {};                                      // cubes with triangles
  std::array<NodeBits, 3> edges = {};                       // edges with a vertex, per axis
  std::array<std::array<std::uint16_t, 3>, 8> before = {};  // vertices that precede [slice][axis]
  std::uint32_t n_vertices = 0;
  std::uint32_t n_faces = 0;
};

// std::popcount may be a function call, depending on the processor; this code is not.
int count_bits(std::uint64_t x) {
  x -= (x >> 1) & 0x5555555555555555ULL;
  x = (x & 0x3333333333333333ULL) + ((x >> 2) & 0x3333333333333333ULL);
  x = (x + (x >> 4)) & 0x0f0f0f0f0f0f0f0fULL;
  return static_cast<int>((x * 0x0101010101010101ULL) >> 56);
}

template <typename Visit>
void for_each_bit(std::uint64_t bits, Visit visit) {
  for (; bits != 0; bits &= bits - 1) visit(std::countr_zero(bits));
}

// The block and the seven blocks above it, at [dx + 2 dy + 4 dz], or the seven below it.
using Octet = std::array<std::int32_t, 8>;
Octet octet(const BlockGrid& grid, std::size_t block, int direction) {
  Octet result;
  for (int o = 0; o < 8; ++o) {
    const int place = 13 + direction * ((o & 1) + 3 * ((o >> 1) & 1) + 9 * (o >> 2));
    result[o] = grid.neighbours[block][place];
  }
  return result;
}

constexpr NodeBits kNoBits = {};

// Four words of one slice: word [o] has the bits of node (x, y) + (o & 1, o >> 1).
using Corners = std::array<std::uint64_t, 4>;
Corners corners_of_slice(const std::array<const NodeBits*, 8>& bits, int z) {
  const int up = z == 8 ? 4 : 0;
  const auto word = [&](int o) { return (*bits[o + up])[z & 7]; };
  const std::uint64_t x = from_next_x(word(0), word(1));
  return {word(0), x, from_next_y(word(0), word(2)), from_next_y(x, from_next_x(word(2), word(3)))};
}

// Corners of the block's cubes in nine slices.
using CornerSlices = std::array<Corners, 9>;
CornerSlices corner_slices(const std::vector<BlockSurface>& blocks, const Octet& above,
                           NodeBits NodeMasks::*which) {
  std::array<const NodeBits*, 8> bits;
  for (int o = 0; o < 8; ++o) {
    bits[o] = above[o] == kNoBlock ? &kNoBits : &(blocks[above[o]].nodes.*which);
  }
  CornerSlices slices;
  for (int z = 0; z < 9; ++z) slices[z] = corners_of_slice(bits, z);
  return slices;
}

std::uint64_t all_of(const Corners& c) { return c[0] & c[1] & c[2] & c[3]; }
std::uint64_t any_of(const Corners& c) { return c[0] | c[1] | c[2] | c[3]; }

// Returns the case (see marching_cubes_table.h) of the cube with bit `bit` of slice z.
unsigned case_of(const CornerSlices& inside, int z, int bit) {
  unsigned result = 0;
  for (int o = 0; o < 4; ++o) {
    result |= static_cast<unsigned>(inside[z][o] >> bit & 1) << o;
    result |= static_cast<unsigned>(inside[z + 1][o] >> bit & 1) << (o + 4);
  }
  return result;
}

void find_cubes(const BlockGrid& grid, std::size_t b, std::vector<BlockSurface>& blocks) {
  const Octet above = octet(grid, b, 1);
  const CornerSlices known = corner_slices(blocks, above, &NodeMasks::known);
  const CornerSlices inside = corner_slices(blocks, above, &NodeMasks::inside);
  BlockSurface& block = blocks[b];
  const std::array<SurfaceCase, 256>& table = surface_table();
  for (int z = 0; z < 8; ++z) {
    const std::uint64_t some = any_of(inside[z]) | any_of(inside[z + 1]);
    const std::uint64_t all = all_of(inside[z]) & all_of(inside[z + 1]);
    block.cubes[z] = all_of(known[z]) & all_of(known[z + 1]) & some & ~all;
    for_each_bit(block.cubes[z],
                 [&](int bit) { block.n_faces += table[case_of(inside, z, bit)].n_faces; });
  }
}

// Finds edges with both signs in cubes with triangles. An edge along x from node (x,
// y, z) belongs to the cubes at (x, y, z) - {(0,0,0), (0,1,0), (0,0,1), (0,1,1)}.
void find_edges(const BlockGrid& grid, std::size_t b, std::vector<BlockSurface>& blocks) {
  const Octet above = octet(grid, b, 1);
  const Octet below = octet(grid, b, -1);
  const auto cubes = [&](int o, int z) -> std::uint64_t {
    const std::int32_t other = below[o | (z < 0 ? 4 : 0)];
    return other == kNoBlock ? 0 : blocks[other].cubes[z & 7];
  };
  const auto inside = [&](int o, int z) -> std::uint64_t {
    const std::int32_t other = above[o | (z > 7 ? 4 : 0)];
    return other == kNoBlock ? 0 : blocks[other].nodes.inside[z & 7];
  };
  BlockSurface& block = blocks[b];
  for (int z = 0; z < 8; ++z) {
    const std::uint64_t here = inside(0, z);
    const auto last_x = [&](int y, int s) {
      return from_last_x(cubes(2 * y, s), cubes(2 * y + 1, s));
    };
    const std::uint64_t own = cubes(0, z);
    const std::uint64_t x = last_x(0, z);
    const std::uint64_t y = from_last_y(own, cubes(2, z));
    const std::uint64_t below_own = cubes(0, z - 1);
    const std::uint64_t along_x = own | y | below_own | from_last_y(below_own, cubes(2, z - 1));
    const std::uint64_t along_y = own | x | below_own | last_x(0, z - 1);
    const std::uint64_t along_z = own | x | y | from_last_y(x, last_x(1, z));
    block.edges[0][z] = (here ^ from_next_x(here, inside(1, z))) & along_x;
    block.edges[1][z] = (here ^ from_next_y(here, inside(2, z))) & along_y;
    block.edges[2][z] = (here ^ inside(0, z + 1)) & along_z;
    for (int axis = 0; axis < 3; ++axis) {
      block.before[z][axis] = static_cast<std::uint16_t>(block.n_vertices);
      block.n_vertices += count_bits(block.edges[axis][z]);
    }
  }
}

// Output positions of the grid's vertices and triangles.
struct Places {
  std::vector<std::uint32_t> vertices, faces;  // first of each block, and the end
};

// Computes the positions; only the first `n_own` blocks have triangles.
Places places_of(const std::vector<BlockSurface>& blocks, std::size_t n_own) {
  Places places;
  places.vertices.assign(blocks.size() + 1, 0);
  places.faces.assign(blocks.size() + 1, 0);
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    vertices += blocks[b].n_vertices;
    if (b < n_own) triangles += blocks[b].n_faces;
    places.vertices[b + 1] = static_cast<std::uint32_t>(vertices);
    places.faces[b + 1] = static_cast<std::uint32_t>(triangles);
  }
  // Half-edges, three per triangle, must have numbers below 2^31.
  constexpr std::uint64_t kLimit = (std::uint64_t{1} << 31) / 3;
  if (triangles > kLimit || vertices > kLimit) {
    throw Error(ErrorCode::kUnsupported,
                fmt::format("the surface has {} faces, the limit is {}: take a coarser "
                            "resolution",
                            triangles, kLimit));
  }
  return places;
}

void write_vertices(const BlockGrid& grid, std::size_t b, const BlockSurface& block,
                    std::size_t first, ExtractedSurface& result) {
  const Octet above = octet(grid, b, 1);
  const float* const own = grid.block_values(b);
  std::size_t v = first;
  for (int z = 0; z < 8; ++z) {
    for (int axis = 0; axis < 3; ++axis) {
      const int stride = 1 << 3 * axis;
      for_each_bit(block.edges[axis][z], [&](int bit) {
        const int node = 64 * z + bit;
        // The other end lies in this block, or in the first layer of the next block.
        const bool last = (node >> 3 * axis & 7) == 7;
        const std::size_t other_block = last ? static_cast<std::size_t>(above[1 << axis]) : b;
        const int other = last ? node - 7 * stride : node + stride;
        const double from = own[node];
        const double to = grid.block_values(other_block)[other];
        std::array<double, 3> place = {static_cast<double>(bit & 7), static_cast<double>(bit >> 3),
                                       static_cast<double>(z)};
        place[axis] += std::clamp(from / (from - to), kClosest, 1 - kClosest);
        const BlockCoordinates& c = grid.blocks[b];
        result.mesh.vertices[v] =
            grid.origin +
            grid.step * Vec3{8.0 * c[0] + place[0], 8.0 * c[1] + place[1], 8.0 * c[2] + place[2]};
        if (!result.filled.empty()) {
          result.filled[v] = grid.is_filled(b, node) || grid.is_filled(other_block, other);
        }
        if (!result.edges.empty()) result.edges[v] = static_cast<std::uint16_t>(node | axis << 9);
        ++v;
      });
    }
  }
}

constexpr std::ptrdiff_t kRow = 9;  // edges of a row

// Vertices of a slice of cubes, by position of their edges: rows of 9 edges, where
// the last row and column belong to the next blocks. Only crossed edges are set.
class SliceVertices {
 public:
  SliceVertices(const std::vector<BlockSurface>& blocks, const Places& places, const Octet& above)
      : blocks_(blocks), places_(places), above_(above) {}

  // Must be called with ascending z before the cubes of slice z.
  void set_slice(int z) {
    for (int s = std::max(z, next_layer_); s <= z + 1; ++s) {
      fill(0, s, layer(0, s));
      fill(1, s, layer(1, s));
    }
    next_layer_ = z + 2;
    fill(2, z, layer(2, z));
    for (int e = 0; e < 12; ++e) {
      const int corner = kEdgeCorner[e];
      offsets_[e] = (layer(e / 4, z + (corner >> 2)) - vertices_.data()) + (corner & 1) +
                    kRow * (corner >> 1 & 1);
    }
  }
  // Returns the vertex on edge e of the cube at `bit`.
  std::uint32_t on(int bit, int e) const {
    return vertices_[static_cast<std::size_t>(offsets_[e] + (bit & 7) + kRow * (bit >> 3))];
  }

 private:
  std::uint32_t* layer(int axis, int slice) {
    const int which = axis == 2 ? 4 : 2 * axis + (slice & 1);
    return vertices_.data() + kRow * kRow * which;
  }

  // Sets the edges along `axis` from the nodes of a slice 0 ... 8.
  void fill(int axis, int slice, std::uint32_t* rows) {
    const int s = slice & 7;
    for (int o = 0; o < 4; ++o) {
      const std::int32_t b = above_[o + 4 * (slice >> 3)];
      if (b == kNoBlock) continue;
      const std::uint64_t all = blocks_[b].edges[axis][s];
      const std::uint32_t first = places_.vertices[b] + blocks_[b].before[s][axis];
      std::uint32_t* const to = rows + std::ptrdiff_t{8} * (o & 1) + 8 * kRow * (o >> 1);
      if ((o & 1) == 0) {  // consecutive rows: all of them, or only the first
        std::uint32_t v = first;
        for_each_bit(o == 0 ? all : all & 0xff,
                     [&](int bit) { to[(bit & 7) + kRow * (bit >> 3)] = v++; });
      } else {  // the first column, or the first node
        for_each_bit(all & (o == 1 ? kFirstColumn : 1), [&](int bit) {
          const std::uint64_t lower = all & ((std::uint64_t{1} << bit) - 1);
          to[kRow * (bit >> 3)] = first + static_cast<std::uint32_t>(count_bits(lower));
        });
      }
    }
  }

  const std::vector<BlockSurface>& blocks_;
  const Places& places_;
  const Octet& above_;
  int next_layer_ = 0;
  std::array<std::ptrdiff_t, 12> offsets_ = {};
  std::array<std::uint32_t, 5 * 81> vertices_;  // along x in two slices, y in two, z in one
};

void write_triangles(const BlockGrid& grid, const std::vector<BlockSurface>& blocks,
                     const Places& places, std::size_t b, std::vector<Triangle>& triangles) {
  const Octet above = octet(grid, b, 1);
  const CornerSlices inside = corner_slices(blocks, above, &NodeMasks::inside);
  const std::array<SurfaceCase, 256>& table = surface_table();
  SliceVertices vertices(blocks, places, above);
  std::size_t t = places.faces[b];
  for (int z = 0; z < 8; ++z) {
    if (blocks[b].cubes[z] == 0) continue;
    vertices.set_slice(z);
    for_each_bit(blocks[b].cubes[z], [&](int bit) {
      const SurfaceCase& surface = table[case_of(inside, z, bit)];
      for (std::size_t i = 0; i < surface.n_faces; ++i) {
        const std::uint8_t* const edges = surface.faces.data() + 3 * i;
        triangles[t++] = {vertices.on(bit, edges[0]), vertices.on(bit, edges[1]),
                          vertices.on(bit, edges[2])};
      }
    });
  }
}

std::vector<BlockSurface> scan_blocks(const BlockGrid& grid, const Context& context) {
  std::vector<BlockSurface> blocks(grid.n_blocks());
  const auto for_blocks = [&](const auto& body) {
    parallel_for(blocks.size(), kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) body(b);
    });
  };
  for_blocks([&](std::size_t b) { node_masks(grid.block_values(b), 1, &blocks[b].nodes); });
  for_blocks([&](std::size_t b) { find_cubes(grid, b, blocks); });
  for_blocks([&](std::size_t b) { find_edges(grid, b, blocks); });
  return blocks;
}

constexpr std::size_t kAllBlocks = ~std::size_t{0};

// Makes triangles of the first `n_own` blocks. Calls `values_are_done` once
// the vertices are written, because the values are not read afterwards.
ExtractedSurface extract(const BlockGrid& grid, std::size_t n_own,
                         const std::function<void()>& values_are_done, const Context& context) {
  const std::vector<BlockSurface> blocks = scan_blocks(grid, context);
  const std::size_t n_cut = std::min(n_own, blocks.size());
  Places places = places_of(blocks, n_cut);
  ExtractedSurface result;
  const std::size_t n_vertices = places.vertices.back();
  resize_large(result.mesh.vertices, n_vertices, room_for_copies(n_vertices), context);
  if (!grid.filled.empty()) result.filled.resize(n_vertices);
  if (n_own != kAllBlocks) result.edges.resize(n_vertices);
  const auto for_blocks = [&](std::size_t n_blocks, std::uint32_t BlockSurface::*n,
                              const auto& write) {
    parallel_for(n_blocks, kGrain, context, {}, [&](std::size_t begin, std::size_t end) {
      for (std::size_t b = begin; b < end; ++b) {
        if (blocks[b].*n > 0) write(b);
      }
    });
  };
  for_blocks(blocks.size(), &BlockSurface::n_vertices, [&](std::size_t b) {
    write_vertices(grid, b, blocks[b], places.vertices[b], result);
  });
  values_are_done();
  const std::size_t n_faces = places.faces.back();
  resize_large(result.mesh.faces, n_faces, room_for_copies(n_faces), context);
  for_blocks(n_cut, &BlockSurface::n_faces,
             [&](std::size_t b) { write_triangles(grid, blocks, places, b, result.mesh.faces); });
  result.first_vertex = std::move(places.vertices);
  return result;
}

}  // namespace

ExtractedSurface extract_surface(const BlockGrid& grid, const Context& context) {
  return extract(
      grid, kAllBlocks, [] {}, context);
}

ExtractedSurface extract_part(const BlockGrid& grid, std::size_t n_blocks, const Context& context) {
  return extract(
      grid, n_blocks, [] {}, context);
}

ExtractedSurface extract_last_surface(BlockGrid& grid, const Context& context) {
  return extract(
      grid, kAllBlocks, [&] { grid.values = {}; }, context);
}

}  // namespace rholm
