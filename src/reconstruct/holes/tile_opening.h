// Cuts the surface of all tiles open where there are no points (method 7.10). Layer: reconstruct,
// private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parts/store.h"
#include "reconstruct/surface/tile_gather.h"
#include "reconstruct/surface/tile_surface.h"
#include "rholm/context.h"

namespace rholm {

// See TileSurface::begin_round().
inline constexpr const char* kOpenRound = "open";

// Meshes must have their support: see TileSurface::extract().
class TileOpening {
 public:
  TileOpening(PieceStore& store, TileSurface& surface, std::size_t n_tiles)
      : store_(store), surface_(surface), n_tiles_(n_tiles) {}

  // Finds the connected parts of a tile's mesh that have no support: "gaps/TILE".
  void find(std::size_t tile);
  bool has(std::size_t tile) const;
  // After find() of all tiles: cuts away parts without support of at least `least_area`, as trim()
  // does. Only the surface near the new borders is in memory.
  void cut(double least_area, const Context& context);

 private:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  void join(double least_area);
  std::vector<std::uint32_t> parts(std::size_t tile) const;  // of each vertex, or kNone
  // Returns the support of each vertex; kept parts without support have kBridged.
  std::vector<double> gathered_support(const GatheredPart& part) const;
  std::vector<double> support(std::size_t tile, const TileMesh& mesh) const;

  PieceStore& store_;
  TileSurface& surface_;
  std::size_t n_tiles_;
  std::vector<std::vector<std::uint8_t>> is_kept_ = {};  // of the parts of each tile
};

}  // namespace rholm
