// Plate models: tables of vertices and of plates, each behind its count. Layer: io.
#pragma once

#include <span>

#include "io/shapes/shape_source.h"

namespace rholm {

// Vertices are rows `x y z` or `number x y z`; plates `a b c`, `number a b c`, `3 a b c`, or `a b
// c` behind a line `3`. Both counts may stand in the first line. (NAIF's plate model type 1; PDS.)
bool looks_like_plate_table(std::span<const char> bytes);
ShapeFile read_plate_table(const ShapeSource& source);

}  // namespace rholm
