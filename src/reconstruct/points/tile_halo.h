// The points of a tile and its halo. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "parts/store.h"
#include "reconstruct/points/tile_plan.h"
#include "reconstruct/points/tile_points.h"

namespace rholm {

struct TileAndHalo {
  // Points of one other tile.
  struct Part {
    std::size_t tile = 0;
    std::vector<std::uint32_t> places = {};  // of its points, in their order
  };
  PointCloud cloud = {};  // the tile's own points, in their order, then the points of each part
  std::size_t n_own = 0;
  std::vector<Part> halo = {};  // by tiles
};

// Reads a tile, and the points of other tiles in its box made wider by `halo` on all sides.
TileAndHalo read_with_halo(const PieceStore& store, const TilePlan& plan, std::size_t tile,
                           double halo);

// Returns one value for each point of the cloud; `values_of(tile)` has the values of a tile.
template <typename T, typename ValuesOf>
std::vector<T> gather(const TileAndHalo& points, std::size_t tile, const ValuesOf& values_of) {
  std::vector<T> values = values_of(tile);
  values.reserve(points.cloud.points.size());
  for (const TileAndHalo::Part& part : points.halo) {
    const std::vector<T> others = values_of(part.tile);
    for (const std::uint32_t i : part.places) values.push_back(others.at(i));
  }
  return values;
}

}  // namespace rholm
