// Computes directions of normals by local fits. Layer: shape.
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

inline constexpr int kGraphNeighbors = 10;  // chosen: Hoppe's graph stays connected and small

// Largest number of neighbours for paraboloids. With more noise they gain nothing over planes and
// take twice the time (scripts/constants, noise of 0.2 % of the diagonal); edges are not resolved.
inline constexpr int kMostForCurvature = 50;

// Fits to more neighbours than this hardly differ between near points, and take long: points share
// them.
inline constexpr int kMostForOwnFits = 252;

// Results of the fits, in the order of the tree. All points are distinct.
struct LocalFits {
  std::vector<Vec3> normals;    // unit, of either sign; zero if the neighbours define no plane
  std::vector<float> radius;    // distance to the last neighbour of the fit
  std::vector<float> residual;  // rms distance of the neighbours to their plane, over the radius
  std::vector<std::uint32_t> neighbors;  // kGraphNeighbors nearest of each point; itself as filling
  int n_neighbors = 0;                   // number of neighbours of a fit
  double typical_residual = 0;           // median of the residuals
  // Places of the points on the fitted surfaces, for the signs of much noise: only for fits of more
  // points than kMostForOwnFits; otherwise empty.
  std::vector<Vec3> settled = {};
  bool noisy = false;  // true if noise, not curvature, causes the residual
};

// Fits weighted planes, then paraboloids, to the `n_neighbors` nearest points, or for 0 to a number
// derived from the data. Where two smooth parts meet, it fits planes to one of them (see
// refine_at_edges()). Normals in `given` (may be empty) that are not zero are kept. Points flagged
// in `skipped` (may be empty) get no fit. Flags are for neighbourhoods beyond kMostForCurvature,
// where no other point needs the fit.
LocalFits fit_normals(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
                      std::span<const Vec3> given, int n_neighbors, const Context& context,
                      std::span<const std::uint8_t> skipped = {});

// Returns LocalFits::noisy for a fit of n_neighbors points.
bool are_noisy(int n_neighbors);

// Computes LocalFits::neighbors alone. In rows of a scan, half of them are the nearest points; the
// others are spread over the disc that reaches other rows.
std::vector<std::uint32_t> graph_neighbors(const PointTree& tree, const SamplingGaps& gaps,
                                           const Context& context);
// Fills row i. `found`: point i and its stride * kGraphNeighbors nearest points, or all points.
void keep_graph_neighbors(std::size_t i, std::size_t stride, std::span<const Neighbor> found,
                          std::span<std::uint32_t> rows);

// Fits again to neighbours on the same sheet. `sheet`: unit vectors that point outwards
// and distinguish two close sheets. Where a fit disagrees with the vector, the normal is
// the vector. Normals point outwards. Returns residuals relative to the radius, 1 where a
// fit and its vector disagree.
std::vector<float> refit_on_sheets(const PointTree& tree, std::span<const Vec3> points,
                                   const SamplingGaps& gaps, std::span<const Vec3> sheet,
                                   LocalFits& fits, const Context& context);

// Returns the number of neighbours with the least error of normals. The error is the sum of
// a variance, from two disjoint halves of the neighbours, and a bias, from the change
// against smaller neighbourhoods.
int choose_neighbors(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
                     const Context& context);

// Improves fits of points near an edge, which have neighbours on both of its sides. Planes through
// the point are proposed by its neighbours' normals. The point takes the plane that most neighbours
// are close to, if it is good enough.
void refine_at_edges(const PointTree& tree, std::span<const Vec3> points, const SamplingGaps& gaps,
                     LocalFits& fits, const Context& context);

// Neighbours of a point, relative to it, in units of the distance to the last neighbour.
struct Neighborhood {
  std::vector<Neighbor> found;
  std::vector<Vec3> points;
  std::vector<double> weights;
  double radius = 0;

  // Takes every `stride`-th of the k * stride nearest points, by distance.
  void gather(const PointTree& tree, std::span<const Vec3> all, std::size_t i, std::size_t k,
              std::size_t stride = 1);
};

}  // namespace rholm
