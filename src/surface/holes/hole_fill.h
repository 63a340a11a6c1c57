// Smooth values where there is only the winding number (method 7.10). Layer: surface.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/queries/winding_tree.h"
#include "surface/grid/block_grid.h"
#include "surface/holes/close_grid.h"
#include "surface/holes/hole_sets.h"
#include "surface/holes/seen_space.h"

namespace rholm {

// The surface near a hole, as a cap has it: a point of the cap's surface, its unit outward normal
// there, and the radius of its cap's support.
struct FootPoint {
  Vec3 at;
  Vec3 normal;
  double support = 0;
};

// The foot points near some holes, and perhaps more.
using FeetNear = std::function<std::vector<FootPoint>(std::span<const Hole> holes)>;

// How far data reach at each of x: support[i] is 1 where the value of the grid is to be believed
// and 0 where it is a cap's guess, far from all points.
using NodeSupport = std::function<void(std::span<const Vec3> x, std::span<double> support)>;

struct HoleFillOptions {
  std::size_t max_blocks = 0;  // of the grid; see close_grid()
  // If given, known nodes around a hole with less support than 1 take over part of the fill, and
  // the surface at those with support 1 guides it.
  NodeSupport support = {};
  // If given, nothing is filled where it is empty.
  const SeenSpace* seen = nullptr;
  const GridPart* part = nullptr;  // if the grid is one
};

struct HoleFilling {
  std::size_t holes = 0;   // connected sets of nodes without data
  std::size_t smooth = 0;  // of those, filled smoothly; the others are left to the winding number
  std::size_t filled_nodes = 0;
};

// Closes the grid: by the winding number first (close_grid()); then, hole by hole, by a Hermite
// RBF through foot points around its rim, so that the fill meets its border with the same normals.
// Foot points must lie on the surface the known values describe; they are thinned out here.
// Nodes without data are marked as filled. Deterministic.
HoleFilling fill_holes(BlockGrid& grid, const FeetNear& feet, const WindingNumbers& winding,
                       const HoleFillOptions& options, const Context& context = {});
// How far from a hole's centre feet count, but for what is beyond the longest support.
double reach_of_feet(const Hole& hole, double step);

}  // namespace rholm
