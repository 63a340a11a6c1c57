// Assigns values to as few unknown nodes as close the surface (method 7.6). Layer: surface.
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

// Sets values[i] at x[i] to a signed distance, correct to first order, positive outside.
using NodeValues = std::function<void(std::span<const Vec3> x, std::span<double> values)>;

struct Closing {
  std::size_t filled_nodes = 0;
  std::size_t added_blocks = 0;
  std::size_t rounds = 0;
  std::vector<std::uint32_t> seen;  // blocks that were searched, ascending
};

// Describes a grid that is a part of a larger one.
struct GridPart {
  std::vector<std::uint32_t> open;  // contains all blocks with open cubes
  // Adds the blocks and values that the larger grid has around these blocks.
  std::function<void(BlockGrid& grid, std::span<const std::uint32_t> blocks)> complete;
};

// A cube is open if it has an unknown corner and both signs among its known corners.
// Asks for values at the unknown corners of open cubes, adding blocks where
// necessary, until no cube is open. The surface then has no border. The new nodes are
// marked as filled; a value that is not finite counts as outside. Throws OutOfMemory
// above `max_blocks`, InvalidInput if the level set of `values` does not close in the
// grid. With a part, searches only its open blocks and the blocks that change.
Closing close_grid(BlockGrid& grid, const NodeValues& values, std::size_t max_blocks,
                   const Context& context = {}, const GridPart* part = nullptr);

// Returns which of the first `n_blocks` have open cubes,
// ascending. All blocks around these blocks must be in the grid.
std::vector<std::uint32_t> open_blocks(const BlockGrid& grid, std::size_t n_blocks,
                                       const Context& context = {});

// Clears doubtful values (one bit per node, 8 words per block) whose sign the
// winding number refutes. A cap that ends beyond a sharp edge or a thin tip has
// wrong values there, which make horns. Returns the number of cleared values.
std::size_t clear_refuted(BlockGrid& grid, std::span<const std::uint64_t> doubtful,
                          const WindingNumbers& winding);

// Returns (1/2 - w) 2 step: one step for the winding numbers 0 and 1. In a hole it
// crosses zero over the hole's own size, so only its sign and its zero have a meaning.
double winding_value(double winding, double step);
NodeValues winding_values(const WindingNumbers& winding, double step);

}  // namespace rholm
