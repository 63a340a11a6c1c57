// A surface made in tiles is the same as in one piece.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "reconstruct/field/narrow_blocks.h"
#include "reconstruct/field/tile_grid.h"
#include "reconstruct/surface/tile_mesh.h"
#include "rholm/error.h"
#include "surface/level_set/extract.h"

namespace rholm {
namespace {

// Two overlapping balls, as an example: distances are exact to first order.
double field(const Vec3& x) {
  return std::min(norm(x - Vec3{-0.35, 0.1, 0}) - 0.7, norm(x - Vec3{0.5, -0.2, 0.1}) - 0.6);
}

constexpr double kStep = 0.043;
const Vec3 kOrigin{-1.117, -1.031, -0.999};

// Makes a grid with values within three steps of the surface.
BlockGrid make_grid(std::vector<BlockCoordinates> blocks) {
  BlockGrid grid = make_block_grid(kOrigin, kStep, std::move(blocks));
  for (std::size_t b = 0; b < grid.n_blocks(); ++b) {
    for (std::size_t n = 0; n < BlockGrid::kNodes; ++n) {
      const double value = field(grid.node(b, n));
      if (std::abs(value) < 3 * kStep) grid.block_values(b)[n] = static_cast<float>(value);
    }
  }
  return grid;
}

std::vector<BlockCoordinates> all_blocks() {
  std::vector<BlockCoordinates> blocks;
  for (int z = 0; z < 7; ++z) {
    for (int y = 0; y < 7; ++y) {
      for (int x = 0; x < 7; ++x) blocks.push_back({x, y, z});
    }
  }
  return blocks;
}

// Space is divided into four tiles.
std::uint32_t tile_of(const Vec3& x) { return (x.x + 0.07 < 0 ? 0U : 1U) + (x.y < 0.03 ? 0U : 2U); }
const GridFrame kFrame{kOrigin, kStep, tile_of};

std::vector<std::uint32_t> first(std::size_t n) {
  std::vector<std::uint32_t> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = static_cast<std::uint32_t>(i);
  return all;
}

// Returns the blocks of a tile, from small integers, with neighbouring blocks.
BlockGrid narrow_grid(std::uint32_t tile, std::size_t& n_own) {
  const std::vector<BlockCoordinates> all = all_blocks();
  const OwnBlocks own = own_blocks(kFrame, tile, all);
  n_own = own.own.size();
  std::vector<BlockCoordinates> blocks = own.own;
  blocks.insert(blocks.end(), own.around.begin(), own.around.end());
  BlockGrid grid = make_block_grid(kOrigin, kStep, blocks);
  const BlockGrid whole = make_grid(all);
  for_narrow_blocks(narrow_blocks(whole, first(whole.n_blocks())), kStep,
                    [&](const NarrowBlock& block) {
                      const std::int32_t b = find_block(grid, block.at);
                      if (b == kNoBlock) return;
                      std::copy(block.values.begin(), block.values.end(),
                                grid.block_values(static_cast<std::size_t>(b)));
                    });
  return grid;
}

using Corner = std::array<double, 3>;
using Corners = std::array<Corner, 3>;

Corners corners_of(const Mesh& mesh, const Triangle& t) {
  Corners corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3& v = mesh.vertices[t[k]];
    corners[k] = {v.x, v.y, v.z};
  }
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

TEST(TileSurface, triangles_of_all_tiles_are_those_of_the_whole) {
  const ExtractedSurface whole = extract_surface(make_grid(all_blocks()));
  std::vector<Corners> expected, found;
  for (const Triangle& t : whole.mesh.faces) expected.push_back(corners_of(whole.mesh, t));
  std::vector<TileMesh> tiles;
  std::size_t n_vertices = 0;
  for (std::uint32_t tile = 0; tile < 4; ++tile) {
    std::size_t n_own = 0;
    const BlockGrid grid = narrow_grid(tile, n_own);
    const std::vector<BlockCoordinates> own(
        grid.blocks.begin(), grid.blocks.begin() + static_cast<std::ptrdiff_t>(n_own));
    tiles.push_back(
        tile_mesh(extract_part(grid, n_own), grid, n_own, border_blocks(kFrame, tile, own)));
    n_vertices += tiles.back().n_own;
    const Mesh& mesh = tiles.back().mesh;
    for (const Triangle& t : mesh.faces) found.push_back(corners_of(mesh, t));
    ASSERT_EQ(mesh.vertices.size(), tiles.back().n_own + tiles.back().foreign.size());
    EXPECT_GT(mesh.faces.size(), 100U);
  }
  EXPECT_EQ(n_vertices, whole.mesh.vertices.size());
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
  // Vertices of other tiles have the same positions as in those tiles.
  std::size_t n_foreign = 0;
  for (const TileMesh& tile : tiles) {
    for (std::size_t i = 0; i < tile.foreign.size(); ++i) {
      const VertexKey& key = tile.foreign[i];
      const TileMesh& other = tiles[kFrame.owner({key.x, key.y, key.z})];
      const Vec3 there = other.mesh.vertices[find_shared(other.shared, key)->vertex];
      EXPECT_EQ(tile.mesh.vertices[tile.n_own + i], there);
      ++n_foreign;
    }
  }
  EXPECT_GT(n_foreign, 100U);
  EXPECT_THROW(find_shared(tiles[0].shared, {99, 0, 0, 0}), Error);
}

TEST(TileSurface, blocks_belong_to_one_tile_each) {
  const std::vector<BlockCoordinates> all = all_blocks();
  std::size_t n = 0;
  for (std::uint32_t tile = 0; tile < 4; ++tile) {
    const OwnBlocks blocks = own_blocks(kFrame, tile, all);
    n += blocks.own.size();
    for (const BlockCoordinates& b : blocks.around) {
      EXPECT_NE(kFrame.owner(b), tile);
      EXPECT_FALSE(std::binary_search(blocks.own.begin(), blocks.own.end(), b, comes_before));
    }
    // All 26 neighbours are examined, whatever the shape of tiles.
    std::vector<std::uint32_t> border;
    for (std::uint32_t b = 0; b < blocks.own.size(); ++b) {
      bool at_border = false;
      for (int d = 0; d < 27; ++d) {
        at_border = at_border || kFrame.owner(beside(blocks.own[b], d)) != tile;
      }
      if (at_border) border.push_back(b);
    }
    EXPECT_EQ(border_blocks(kFrame, tile, blocks.own), border);
  }
  EXPECT_EQ(n, all.size());
}

TEST(NarrowBlocks, keep_sides_and_what_the_surface_needs) {
  const BlockGrid grid = make_grid(all_blocks());
  const std::vector<std::byte> bytes = narrow_blocks(grid, first(grid.n_blocks()));
  EXPECT_LT(bytes.size(), grid.n_blocks() * 600);
  std::size_t n = 0, kept = 0;
  for_narrow_blocks(bytes, kStep, [&](const NarrowBlock& block) {
    EXPECT_EQ(block.at, grid.blocks[n]);
    for (std::size_t i = 0; i < BlockGrid::kNodes; ++i) {
      const float before = grid.block_values(n)[i], now = block.values[i];
      ASSERT_EQ(std::isfinite(before), std::isfinite(now));
      if (!std::isfinite(before)) continue;
      ASSERT_EQ(before < 0, now < 0);
      kept += before == now;
      ASSERT_TRUE(before == now || std::abs(now) == static_cast<float>(kStep));
    }
    ++n;
  });
  EXPECT_EQ(n, grid.n_blocks());
  EXPECT_GT(kept, 1000U);
  EXPECT_EQ(places_of_narrow(bytes), grid.blocks);
}

TEST(NarrowBlocks, refuse_damaged_bytes) {
  const BlockGrid grid = make_grid(all_blocks());
  std::vector<std::byte> bytes = narrow_blocks(grid, first(grid.n_blocks()));
  const auto read = [&] { for_narrow_blocks(bytes, kStep, [](const NarrowBlock&) {}); };
  bytes.pop_back();
  EXPECT_THROW(read(), Error);
  bytes.resize(10);
  EXPECT_THROW(read(), Error);
  bytes.clear();
  read();
}

}  // namespace
}  // namespace rholm
