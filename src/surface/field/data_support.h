// How far within the data a place is: where surfaces are cut open, and what holes are made of
// (method 7.10). Layer: surface.
#pragma once

#include <vector>

#include "rholm/atlas.h"
#include "rholm/context.h"
#include "surface/field/cap_field.h"
#include "surface/grid/block_grid.h"
#include "surface/holes/hole_fill.h"
#include "surface/level_set/extract.h"

namespace rholm {

// For each vertex, how far within the data it is: 1 in the middle of a cap's points, 0 on their
// rim, negative beyond all. Guessed vertices (ExtractedSurface::filled) also have to lie on a cap,
// as closely as half of its band.
std::vector<double> data_support(const Atlas& atlas, const CapLists& lists,
                                 const ExtractedSurface& surface, const CapBands& bands,
                                 const Context& context);

// The same at nodes of the grid, as what they are worth to a hole beside them: 1 within the data, 0
// where caps end. Refers to its arguments.
NodeSupport node_support(const Atlas& atlas, const CapLists& lists, const BlockGrid& grid,
                         const Context& context);

}  // namespace rholm
