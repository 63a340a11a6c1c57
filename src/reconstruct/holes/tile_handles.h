// Cuts handles that are smaller than the points can resolve in the surface of all tiles. Layer:
// reconstruct, private.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "parts/store.h"
#include "reconstruct/points/known_spacings.h"
#include "reconstruct/surface/tile_surface.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// The spacing of a tile's points at each of some places near it.
using SpacingsAt =
    std::function<std::vector<double>(std::size_t tile, const std::vector<Vec3>& places)>;

// See TileSurface::begin_round().
inline constexpr const char* kCutRound = "cut";

class TileHandles {
 public:
  TileHandles(PieceStore& store, TileSurface& surface, std::size_t n_tiles, double typical,
              SpacingsAt spacings)
      : store_(store),
        surface_(surface),
        n_tiles_(n_tiles),
        typical_(typical),
        spacings_(std::move(spacings)) {}

  // Finds the places in a tile's extracted mesh where the surface turns around and may be cut:
  // "tight/TILE". Places near the tile's border are left to cut().
  void find(std::size_t tile, TileMesh part, const Context& context);
  bool has(std::size_t tile) const;

  // After find() of all tiles: cuts handles as cut_handles() does in the whole surface, and writes
  // the changed tiles anew. Only the surface near the places is in memory. Returns the number of
  // handles.
  std::size_t cut(const Context& context);

  // Returns the spacings that find() and cut() asked for: "spacings/TILE" and "spacings/all".
  std::vector<PlaceAndSpacing> spacings() const;

 private:
  Bounds decided(std::size_t tile) const;

  PieceStore& store_;
  TileSurface& surface_;
  std::size_t n_tiles_;
  double typical_;
  SpacingsAt spacings_;
};

}  // namespace rholm
