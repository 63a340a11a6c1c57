// A brick's points read with the normals that were found or turned for them. Layer: model, private.
#pragma once

#include <cstddef>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_plan.h"
#include "model/bricks/brick_scene.h"
#include "rholm/context.h"

namespace rholm {

// With the points of others in the box around its own that is wider by `halo` on all sides. Normals
// are turned as mend_bricks() says.
BrickScene load_brick(const PieceStore& store, const BrickPlan& plan, std::size_t brick,
                      double halo, const Context& context);

}  // namespace rholm
