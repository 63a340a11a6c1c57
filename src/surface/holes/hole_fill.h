// Smooth values where only the winding number is known (method 7.10). Layer: surface.
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

// Point on the surface near a hole, taken from a cap: its position,
// the unit outward normal, and the radius of the cap's support.
struct FootPoint {
  Vec3 at;
  Vec3 normal;
  double support = 0;
};

// Returns at least all foot points near the given holes.
using FeetNear = std::function<std::vector<FootPoint>(std::span<const Hole> holes)>;

// Sets support[i] for each of x: 1 where the data determine the grid's
// value, and 0 where the value is a cap's guess, far from all points.
using NodeSupport = std::function<void(std::span<const Vec3> x, std::span<double> support)>;

struct HoleFillOptions {
  std::size_t max_blocks = 0;  // limit of the grid; see close_grid()
  // If given, known nodes around a hole with a support below 1 become part
  // of the fill. The surface at nodes with support 1 guides the fill.
  NodeSupport support = {};
  // If given, nothing is filled in empty space.
  const SeenSpace* seen = nullptr;
  const GridPart* part = nullptr;  // set if the grid is a part
};

struct HoleFilling {
  std::size_t holes = 0;   // connected sets of nodes without data
  std::size_t smooth = 0;  // smoothly filled holes; the other holes keep the winding number
  std::size_t filled_nodes = 0;
};

// Closes the grid, first by the winding number (close_grid()). Then each hole gets a
// Hermite RBF through foot points around its rim, so that the fill has the same normals
// at its border. Foot points must lie on the surface of the known values; they are
// thinned out here. Nodes without data are marked as filled. The result is deterministic.
HoleFilling fill_holes(BlockGrid& grid, const FeetNear& feet, const WindingNumbers& winding,
                       const HoleFillOptions& options, const Context& context = {});
// Returns the distance from a hole's centre within which feet count (includes any support).
double reach_of_feet(const Hole& hole, double step);

}  // namespace rholm
