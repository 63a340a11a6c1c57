// The fits of a patch's caps, blended. Layer: edit.
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

// The part of a mesh that an edit is about.
struct Site {
  LocalMesh local;
  std::vector<double> weights;        // of its points; those above 0 may move
  std::vector<std::uint8_t> ignored;  // points left out of the fits; empty if none
};

// Where fits want the points: a row for each point that may move.
struct Blend {
  std::vector<std::uint32_t> row;   // of each point
  std::vector<double> weight_sums;  // of caps; 0 where none contributes
  std::vector<Vec3> moves;          // [row][degree]: from the point to the fit of that degree
  std::vector<double> rejection;    // residual from which on robust fits have rejected a point
};
Blend blend_caps(const Site& site, const std::vector<PatchCap>& caps, bool robust,
                 const Context& context);

// Points that no cap sees, on the back of a fold, go where their neighbours go.
void follow_neighbours(const Site& site, Blend& blend);

}  // namespace rholm
