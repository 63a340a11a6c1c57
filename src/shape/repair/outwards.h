// Closed parts of a mesh turned outwards, those within others inwards.
#pragma once

#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/repair.h"
#include "shape/repair/sheets.h"

namespace rholm {

// Marks the triangles that must turn: `turned[t]` becomes 1 minus itself. Coordinates of the order
// of 1; parts are oriented alike unless they are one-sided. Counts what it finds in `report`.
void turn_outwards(const Mesh& mesh, const Parts& parts, const std::vector<std::uint32_t>& mates,
                   std::vector<char>& turned, RepairReport& report, const Context& context);

}  // namespace rholm
