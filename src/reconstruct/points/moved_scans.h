// Scans of more points than a tile, brought together. Layer: reconstruct, private.
#pragma once

#include <memory>

#include "parts/store.h"
#include "reconstruct/points/point_source.h"
#include "rholm/context.h"
#include "rholm/points.h"
#include "rholm/reconstruct.h"

namespace rholm {

// The source with its scans where align_scans() brings a sample of them: at most
// options.tile_points points, the same in any order of the source. `alignment` gets what was done.
// The source itself where there are no scans, or these stay. The store keeps the motions.
std::unique_ptr<PointSource> with_moved_scans(std::unique_ptr<PointSource> source,
                                              PieceStore& store, const ReconstructOptions& options,
                                              ScanAlignment& alignment, const Context& context);

}  // namespace rholm
