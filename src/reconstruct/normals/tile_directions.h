// Normals of the points of a tile up to their signs. Layer: reconstruct, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "parts/store.h"
#include "reconstruct/points/tile_halo.h"
#include "reconstruct/points/tile_plan.h"
#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/normals.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

// A tile and its halo without normals, in the order of a tree.
struct BareTile {
  TileAndHalo read = {};
  std::unique_ptr<PointTree> tree = {};
  std::vector<Vec3> points = {};
  std::vector<std::uint8_t> foreign = {};  // 1 of the halo
  // Empty as long as find_gaps() or put_fits() has not been called.
  SamplingGaps gaps = {};
  LocalFits fits = {};
};
BareTile load_bare(const PieceStore& store, const TilePlan& plan, std::size_t tile, double halo,
                   const Context& context);

// Fit at one point, in single precision.
struct PointDirection {
  float x = 0, y = 0, z = 0;       // of a unit normal; zero for none
  float radius = 0, residual = 0;  // as in LocalFits
  float gap = 1;                   // as in SamplingGaps
};
std::string directions_name(std::size_t tile);
std::vector<PointDirection> read_directions(const PieceStore& store, std::size_t tile);

void find_gaps(BareTile& tile, const Context& context);
// Returns how far beyond a tile its fits look, in spacings.
double reach_of_fits(int n_neighbors);
// Returns the directions of a tile's own points. The tile must have this halo and its gaps.
std::vector<PointDirection> fit_directions(const BareTile& tile, int n_neighbors,
                                           const Context& context);
// Reads the gaps and fits of a tile's points that all tiles have written, without neighbours.
void put_fits(const PieceStore& store, std::size_t tile, int n_neighbors, BareTile& bare);
// Does the same as put_fits(), and finds the graph of neighbours.
void put_graph(const PieceStore& store, std::size_t tile, int n_neighbors, BareTile& bare,
               const Context& context);

}  // namespace rholm
