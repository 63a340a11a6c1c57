// Directions of normals by local fits. Layer: shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rholm/context.h"
#include "rholm/vec3.h"
#include "shape/points/point_tree.h"
#include "shape/points/sampling_gaps.h"

namespace rholm {

inline constexpr int kGraphNeighbors = 10;  // chosen: Hoppe's graph holds together, and is small

// Where noise asks for more than that, planes are as good as paraboloids and edges cannot be told
// (scripts/constants, noise of 0.2 % of the diagonal: no gain, half the time).
inline constexpr int kMostForCurvature = 50;

// Everything is in the order of the tree; points are distinct.
struct LocalFits {
  std::vector<Vec3> normals;    // unit, of either sign; zero where the neighbours have no plane
  std::vector<float> radius;    // distance to the last neighbour of the fit
  std::vector<float> residual;  // rms distance of the neighbours to their plane, over the radius
  std::vector<std::uint32_t> neighbors;  // kGraphNeighbors nearest of each, itself where fewer
  int n_neighbors = 0;                   // of a fit
  double typical_residual = 0;           // median
  bool noisy = false;  // the residual is that of the points, not of the shape's curvature
};

// Weighted planes, then paraboloids, over the `n_neighbors` nearest points, or as many as the data
// ask for if that is 0; where two smooth parts meet, planes through one of them (see
// refine_at_edges). Keeps `given` normals that are not zero, if there are any. Points that are
// `skipped`, if there are any, get no fit: for neighbourhoods beyond kMostForCurvature, where none
// is needed by others.
LocalFits fit_normals(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
                      std::span<const Vec3> given, int n_neighbors, const Context& context,
                      std::span<const std::uint8_t> skipped = {});

// Whether a fit of so many neighbours is one of noisy points (LocalFits::noisy).
bool are_noisy(int n_neighbors);

// LocalFits::neighbors alone: in rows half of them are the nearest, the others of the disc that
// reaches other rows.
std::vector<std::uint32_t> graph_neighbors(const PointTree& tree, const SamplingGaps& gaps,
                                           const Context& context);
// The row of one point: `found` has itself and its stride * kGraphNeighbors nearest points, or all.
void keep_graph_neighbors(std::size_t i, std::size_t stride, std::span<const Neighbor> found,
                          std::span<std::uint32_t> rows);

// Fits once more, to the neighbours on the same side of `sheet` only: unit vectors that point out
// of what the points bound, which tell two close sheets apart. Where a fit has nothing to do with
// its own the vector's direction is taken. The normals point out. Returns the residuals of the
// fits, of their radius; 1 where they have nothing to do with the vectors.
std::vector<float> refit_on_sheets(const PointTree& tree, std::span<const Vec3> points,
                                   const SamplingGaps& gaps, std::span<const Vec3> sheet,
                                   LocalFits& fits, const Context& context);

// The number of neighbours that makes the error of normals least: the sum of a variance, from two
// disjoint halves of the neighbours, and of a bias, from the change against smaller
// neighbourhoods.
int choose_neighbors(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
                     const Context& context);

// Points near an edge have neighbours on both sides, and a fit across. They take the plane through
// themselves and one side, if there is one: that of a neighbour's normal which most neighbours lie
// in closely.
void refine_at_edges(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
                     LocalFits& fits, const Context& context);

// The neighbours of a point, relative to it, in units of the distance of the last.
struct Neighborhood {
  std::vector<Neighbor> found;
  std::vector<Vec3> points;
  std::vector<double> weights;
  double radius = 0;

  // Of the k * stride nearest one in `stride`, by distance.
  void gather(const PointTree& tree, std::span<const Vec3> all, std::size_t i, std::size_t k,
              std::size_t stride = 1);
};

}  // namespace rholm
