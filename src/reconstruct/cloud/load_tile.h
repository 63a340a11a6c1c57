// A tile's points read with the normals that were found or turned for them. Layer: reconstruct,
// private.
#pragma once

#include <cstddef>
#include <memory>

#include "parts/store.h"
#include "reconstruct/points/tile_plan.h"
#include "reconstruct/points/tile_scene.h"
#include "rholm/context.h"

namespace rholm {

// With the points of others in the box around its own that is wider by `halo` on all sides. Normals
// are turned as mend_tiles() says. `tree` is a tree of these points, which saves a new one. It is
// not used if points have been removed since, because they have no normals.
TileScene load_tile(const PieceStore& store, const TilePlan& plan, std::size_t tile, double halo,
                    const Context& context, std::unique_ptr<PointTree> tree = nullptr);

}  // namespace rholm
