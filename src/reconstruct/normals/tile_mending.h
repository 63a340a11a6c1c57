// Normals of tiles that contradict those around them: found, and turned. Layer: reconstruct,
// private.
//
// "sign-pieces/TILE" has what a tile knows of its own points (shape/points/sign_pieces.h),
// "sign-links/TILE" which of its pieces are pieces of others too, and "signs-joined" what comes of
// all together. Then "turned/TILE" has a flag for each point, and the piece "signs-mended" says
// that all is there.
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
  bool mend = true;    // else contradictions are counted only
  bool closed = true;  // the surface is to be closed
  // Points of one tile with those around it.
  std::function<std::shared_ptr<const TileScene>(std::size_t tile)> load;
  // Their graph_neighbors(), or nothing.
  std::function<std::vector<std::uint32_t>(std::size_t tile)> neighbors;
  std::uint64_t points = 0;      // of all tiles
  std::uint64_t samples = 0;     // of all tiles
  std::size_t around = 0;        // neighbours that tell the area of a point: see sample_tile()
  std::uint64_t max_memory = 0;  // bytes
};

struct TileMendingReport {
  std::uint64_t turned = 0;                   // points
  std::uint64_t all_inward = 0;               // 1: none contradicted the others, and all are turned
  std::uint64_t contradicting = 0;            // points that still do
  std::uint64_t named = 0;                    // so many of them are in `first`
  std::array<Vec3, kNamedPoints> first = {};  // of these
  double inward = 0;                          // as in MendedSigns
};

// All steps. Done already where the store has it from a run before. Throws OutOfMemory where pieces
// are so many that they do not fit into memory.
TileMendingReport mend_tiles(PieceStore& store, const TilePlan& plan,
                             const TileMendingOptions& options, Stages& stages);

// Whether normals of the store are turned, and the flag of each point of a tile, in their order.
bool have_turned(const PieceStore& store);
std::vector<std::uint8_t> read_turned(const PieceStore& store, std::size_t tile);
// Drops those of the points whose flag is set.
void remove_turned(PieceStore& store, std::size_t tile, const std::vector<std::uint8_t>& gone);

}  // namespace rholm
