// Directions of normals in a brick, of either sign. Layer: model, private.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/spill/piece_store.h"
#include "model/bricks/brick_halo.h"
#include "model/bricks/brick_plan.h"
#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/normals.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

// A brick and its halo, in the order of a tree, without normals.
struct BareBrick {
  BrickAndHalo read = {};
  std::unique_ptr<PointTree> tree = {};
  std::vector<Vec3> points = {};
  std::vector<std::uint8_t> foreign = {};  // 1 of the halo
  // Empty as long as find_gaps() or put_fits() has not been called.
  SamplingGaps gaps = {};
  LocalFits fits = {};
};
BareBrick load_bare(const PieceStore& store, const BrickPlan& plan, std::size_t brick, double halo,
                    const Context& context);

// Of one point, in single precision.
struct PointDirection {
  float x = 0, y = 0, z = 0;       // of a unit normal; zero for none
  float radius = 0, residual = 0;  // as in LocalFits
  float gap = 1;                   // as in SamplingGaps
};
std::string directions_name(std::size_t brick);
std::vector<PointDirection> read_directions(const PieceStore& store, std::size_t brick);

void find_gaps(BareBrick& brick, const Context& context);
// How far beyond a brick its fits look, in spacings.
double reach_of_fits(int n_neighbors);
// Of the own points of a brick with a halo as wide as that, and its gaps.
std::vector<PointDirection> fit_directions(const BareBrick& brick, int n_neighbors,
                                           const Context& context);
// The gaps and fits that all bricks have written for these points, without neighbours.
void put_fits(const PieceStore& store, std::size_t brick, int n_neighbors, BareBrick& bare);
// The same, with the graph of neighbours.
void put_graph(const PieceStore& store, std::size_t brick, int n_neighbors, BareBrick& bare,
               const Context& context);

}  // namespace rholm
