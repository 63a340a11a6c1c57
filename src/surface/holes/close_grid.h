// Values for unknown nodes, as few as make the surface closed (method 7.6). Layer: surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/queries/winding_tree.h"
#include "surface/grid/block_grid.h"

namespace rholm {

// Sets values[i] at x[i], a signed distance to first order, positive outside.
using NodeValues = std::function<void(std::span<const Vec3> x, std::span<double> values)>;

struct Closing {
  std::size_t filled_nodes = 0;
  std::size_t added_blocks = 0;
  std::size_t rounds = 0;
  std::vector<std::uint32_t> seen;  // blocks that were looked at, ascending
};

// Of a grid that is a part of a larger one.
struct GridPart {
  std::vector<std::uint32_t> open;  // all blocks with open cubes are among these
  // Adds what the larger grid has around these blocks, with its values.
  std::function<void(BlockGrid& grid, std::span<const std::uint32_t> blocks)> complete;
};

// Wherever a cube has both signs among its known corners and an unknown corner, asks for values at
// its unknown corners, adding blocks where necessary, until there is no such cube: then the
// surface has no border. The nodes are marked as filled; a value that is not finite counts as
// outside. Throws InvalidInput if the grid would need more than `max_blocks`: the level of the
// values asked for does not close then. With a part only what is open is looked at, and what comes
// to be around.
Closing close_grid(BlockGrid& grid, const NodeValues& values, std::size_t max_blocks,
                   const Context& context = {}, const GridPart* part = nullptr);

// Those of the first `n_blocks`, ascending, that have open cubes: both signs among the known
// corners, and an unknown one. All blocks around these must be in the grid.
std::vector<std::uint32_t> open_blocks(const BlockGrid& grid, std::size_t n_blocks,
                                       const Context& context = {});

// Clears doubtful values (one bit per node, 8 words per block) that the winding number refutes: it
// is sure of the other side. A cap that ends beyond a sharp edge or a thin tip has such, and makes
// horns of them. Returns their number.
std::size_t clear_refuted(BlockGrid& grid, std::span<const std::uint64_t> doubtful,
                          const WindingNumbers& winding);

// (1/2 - w) 2 step: one step where the winding number is sure. In a hole it crosses zero over the
// hole's own size, so only its sign and its zero mean something.
double winding_value(double winding, double step);
NodeValues winding_values(const WindingNumbers& winding, double step);

}  // namespace rholm
