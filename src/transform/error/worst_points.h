// The points of a mesh at which an expansion errs most, found without exact sums at all of them.
#pragma once

#include <cstddef>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/error/error_points.h"
#include "transform/error/face_scan.h"

namespace rholm {

struct WorstOptions {
  // Root mean square of the radial errors, about.
  double rms = 0;
  // The largest radial error and the largest distance are at least these.
  double radial = 0, distance = 0;
};

struct WorstPoints {
  ErrorPoints points;  // some of extreme_points(), the largest radial errors first, or all of them
  PointErrors errors;  // with distances
  std::size_t seen = 0;  // of how many
};
// Has the points of the largest radial error and of the largest distance, and so many of the next
// radial errors that climbs and closest points can begin there. All have values of a few
// hundredths of the errors first; distances are no larger than radial errors, so that exact values
// and slopes are wanted from the largest radial error down to the largest distance found.
// `exact`: the model of the expansion that what is found is measured by.
WorstPoints worst_points(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
                         const RadialModel& exact, const WorstOptions& options,
                         const Context& context);

// Points on faces that are long against 1/L: the points of worst_points() lie far apart there.
struct DensePoints {
  ErrorPoints points;    // some, the largest radial errors first, but for the order of near ones
  std::size_t seen = 0;  // of how many, at most 1.5/L apart
};
// Has the points from which climbs may reach the largest radial error. `rms`: the root mean square
// of the radial errors, about; `largest_known`: the largest is at least this.
DensePoints dense_points(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
                         double rms, double largest_known, const Context& context);

}  // namespace rholm
