// Normals of bricks that contradict those around them: found, and turned. Layer: model, private.
//
// "sign-pieces/BRICK" has what a brick knows of its own points (shape/points/sign_pieces.h),
// "sign-links/BRICK" which of its pieces are pieces of others too, and "signs-joined" what comes of
// all together. Then "turned/BRICK" has a flag for each point, and the piece "signs-mended" says
// that all is there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/brick_scene.h"
#include "model/bricks/brick_stages.h"
#include "rholm/vec3.h"
#include "shape/points/sign_check.h"

namespace rholm {

struct BrickMendingOptions {
  bool mend = true;    // else contradictions are counted only
  bool closed = true;  // the surface is to be closed
  // Points of one brick with those around it.
  std::function<BrickScene(std::size_t brick)> load;
  std::uint64_t points = 0;      // of all bricks
  std::uint64_t samples = 0;     // of all bricks
  std::size_t around = 0;        // neighbours that tell the area of a point: see sample_brick()
  std::uint64_t max_memory = 0;  // bytes
};

struct BrickMendingReport {
  std::uint64_t turned = 0;                   // points
  std::uint64_t all_inward = 0;               // 1: none contradicted the others, and all are turned
  std::uint64_t contradicting = 0;            // points that still do
  std::uint64_t named = 0;                    // so many of them are in `first`
  std::array<Vec3, kNamedPoints> first = {};  // of these
  double inward = 0;                          // as in MendedSigns
};

// All steps. Done already where the store has it from a run before. Throws OutOfMemory where pieces
// are so many that they do not fit into memory.
BrickMendingReport mend_bricks(PieceStore& store, const BrickPlan& plan,
                               const BrickMendingOptions& options, BrickStages& stages);

// Whether normals of the store are turned, and the flag of each point of a brick, in their order.
bool have_turned(const PieceStore& store);
std::vector<std::uint8_t> read_turned(const PieceStore& store, std::size_t brick);
// Drops those of the points whose flag is set.
void remove_turned(PieceStore& store, std::size_t brick, const std::vector<std::uint8_t>& gone);

}  // namespace rholm
