// Finds the points of a mesh at which an expansion errs most, without exact sums at all points.
#pragma once

#include <cstddef>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/error/error_points.h"
#include "transform/error/face_scan.h"

namespace rholm {

struct WorstOptions {
  // About the root mean square of the radial errors.
  double rms = 0;
  // The largest radial error and the largest distance are at least these values.
  double radial = 0, distance = 0;
};

struct WorstPoints {
  ErrorPoints points;    // all of extreme_points(), or some: the largest radial errors first
  PointErrors errors;    // with distances
  std::size_t seen = 0;  // number of points examined
};
// Returns the points of the largest radial error and of the largest distance. Adds points of the
// next radial errors, at which climbs and closest points can begin. All points first have values to
// a few hundredths of the errors. Distances are no larger than radial errors. So exact values and
// slopes are needed from the largest radial error down to the largest distance found. `exact` is
// the model of the expansion for exact values.
WorstPoints worst_points(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
                         const RadialModel& exact, const WorstOptions& options,
                         const Context& context);

// Points on faces that are long against 1/L, where the points of worst_points() are far apart.
struct DensePoints {
  ErrorPoints points;    // some, in descending order of approximate radial errors
  std::size_t seen = 0;  // number of points examined, at most 1.5/L apart
};
// Returns the points from which climbs may reach the largest radial error. `rms` is about the rms
// of the radial errors; the largest radial error is at least `largest_known`.
DensePoints dense_points(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
                         double rms, double largest_known, const Context& context);

}  // namespace rholm
