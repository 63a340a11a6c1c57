// Alignment of scans with more points than a tile. Layer: reconstruct, private.
#pragma once

#include <memory>

#include "parts/store.h"
#include "reconstruct/points/point_source.h"
#include "rholm/context.h"
#include "rholm/points.h"
#include "rholm/reconstruct.h"

namespace rholm {

// Returns the source with its scans moved as align_scans() moves a sample: at most
// options.tile_points points, the same in any order of the source. `alignment` gets what was done.
// Returns the source itself if there are no scans or they stay. The store keeps the motions.
std::unique_ptr<PointSource> with_moved_scans(std::unique_ptr<PointSource> source,
                                              PieceStore& store, const ReconstructOptions& options,
                                              ScanAlignment& alignment, const Context& context);

}  // namespace rholm
