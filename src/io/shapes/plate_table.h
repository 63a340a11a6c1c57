// Plate models: tables of vertices and of plates, each after its count. Layer: io.
#pragma once

#include <span>

#include "io/shapes/shape_source.h"

namespace rholm {

// Vertices are rows `x y z` or `number x y z`. Plates are `a b c`, `number a b c`, `3 a b c`, or `a
// b c` after a line `3`. Both counts may be in the first line. (NAIF's plate model type 1; PDS.)
bool looks_like_plate_table(std::span<const char> bytes);
ShapeFile read_plate_table(const ShapeSource& source);

}  // namespace rholm
