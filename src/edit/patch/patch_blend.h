// Blends the fits of a patch's caps. Layer: edit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "edit/patch/patch_cover.h"
#include "edit/region/local_mesh.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

inline constexpr auto kPatchDegrees = static_cast<std::size_t>(kPatchDegree + 1);

// Part of a mesh that an edit uses.
struct Site {
  LocalMesh local;
  std::vector<double> weights;        // weight of each point; points with a weight above 0 may move
  std::vector<std::uint8_t> ignored;  // points left out of the fits; may be empty
};

// Positions wanted by the fits, with one row for each point that may move.
struct Blend {
  std::vector<std::uint32_t> row;   // row of each point
  std::vector<double> weight_sums;  // sum of the caps' weights; 0 where no cap contributes
  std::vector<Vec3> moves;          // [row][degree]: from the point to the fit of that degree
  std::vector<double> rejection;    // least residual at which robust fits rejected a point
};
Blend blend_caps(const Site& site, const std::vector<PatchCap>& caps, bool robust,
                 const Context& context);

// Moves points that no cap reaches, on the back of a fold, like their neighbours.
void follow_neighbours(const Site& site, Blend& blend);

}  // namespace rholm
