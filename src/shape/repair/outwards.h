// Orients closed parts of a mesh outwards, and parts inside of others inwards.
#pragma once

#include <vector>

#include "rholm/context.h"
#include "rholm/mesh.h"
#include "rholm/repair.h"
#include "shape/repair/sheets.h"

namespace rholm {

// Marks triangles that must be flipped: `turned[t]` becomes 1 - turned[t]. Coordinates are of order
// 1; parts are oriented alike unless they are one-sided. Writes counts to `report`.
void turn_outwards(const Mesh& mesh, const Parts& parts, const std::vector<std::uint32_t>& mates,
                   std::vector<char>& turned, RepairReport& report, const Context& context);

}  // namespace rholm
