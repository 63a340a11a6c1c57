// Measures how far within the data a position is: it decides where surfaces are
// cut open, and which values holes take over (method 7.10). Layer: surface.
#pragma once

#include <vector>

#include "rholm/atlas.h"
#include "rholm/context.h"
#include "surface/field/cap_field.h"
#include "surface/grid/block_grid.h"
#include "surface/holes/hole_fill.h"
#include "surface/level_set/extract.h"

namespace rholm {

// Returns for each vertex how far within the data it is: 1 in the middle of a cap's
// points, 0 on their rim, negative beyond. A guessed vertex (ExtractedSurface::filled)
// counts only caps whose surface is within half their band.
std::vector<double> data_support(const Atlas& atlas, const CapLists& lists,
                                 const ExtractedSurface& surface, const CapBands& bands,
                                 const Context& context);

// Returns a function that measures the support of grid nodes for the holes beside them:
// 1 within the data, 0 where caps end. The function refers to the arguments given here.
NodeSupport node_support(const Atlas& atlas, const CapLists& lists, const BlockGrid& grid,
                         const Context& context);

}  // namespace rholm
