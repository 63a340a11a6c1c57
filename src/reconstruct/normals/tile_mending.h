// Finds and turns normals of tiles that contradict the normals around them. Layer: reconstruct,
// private.
//
// The pieces of a tile's own points (shape/points/sign_pieces.h) are in "sign-pieces/TILE". Links
// to pieces of other tiles are in "sign-links/TILE", and the result for all tiles is in
// "signs-joined". Then "turned/TILE" has a flag for each point. The piece "signs-mended" says that
// all is there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "parts/stages.h"
#include "parts/store.h"
#include "reconstruct/points/tile_plan.h"
#include "reconstruct/points/tile_scene.h"
#include "rholm/vec3.h"
#include "shape/points/sign_check.h"

namespace rholm {

struct TileMendingOptions {
  bool mend = true;    // false: contradictions are only counted
  bool closed = true;  // the surface is to be closed
  // Returns the points of one tile and its halo.
  std::function<std::shared_ptr<const TileScene>(std::size_t tile)> load;
  // Returns graph_neighbors() of these points, or nothing.
  std::function<std::vector<std::uint32_t>(std::size_t tile)> neighbors;
  std::uint64_t points = 0;      // of all tiles
  std::uint64_t samples = 0;     // of all tiles
  std::size_t around = 0;        // neighbours that tell the area of a point: see sample_tile()
  std::uint64_t max_memory = 0;  // bytes
};

struct TileMendingReport {
  std::uint64_t turned = 0;                   // points
  std::uint64_t all_inward = 0;               // 1: none contradicted the others, and all are turned
  std::uint64_t contradicting = 0;            // points that still contradict others
  std::uint64_t named = 0;                    // number of them that are in `first`
  std::array<Vec3, kNamedPoints> first = {};  // places of these points
  double inward = 0;                          // as in MendedSigns
};

// Does all steps; a step whose result the store has is skipped. Throws OutOfMemory if there are too
// many pieces for the memory.
TileMendingReport mend_tiles(PieceStore& store, const TilePlan& plan,
                             const TileMendingOptions& options, Stages& stages);

// Says whether the store has flags of turned normals; then returns one flag per point of a tile.
bool have_turned(const PieceStore& store);
std::vector<std::uint8_t> read_turned(const PieceStore& store, std::size_t tile);
// Drops the flags of the points whose `gone` is set.
void remove_turned(PieceStore& store, std::size_t tile, const std::vector<std::uint8_t>& gone);

}  // namespace rholm
