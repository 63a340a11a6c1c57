// An upper bound on the radial error of an expansion over the whole surface, by branch and bound:
// method 5.
#pragma once

#include <cstddef>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/mesh_view.h"
#include "transform/error/face_scan.h"
#include "transform/error/radial_model.h"

namespace rholm {

struct BoundOptions {
  double seen = 0;             // no error at a vertex is larger
  double enough = 0;           // parts of faces whose bound is no larger are not divided
  double doubt = 0;            // largest error of the model's values, in the mesh's unit
  std::size_t most_cells = 0;  // about the largest number of cells to measure
};
struct RadialBound {
  double value = 0;       // no error is larger; infinite if there is no bound
  std::size_t cells = 0;  // number of cells at which errors were computed
};
// The mesh is star-shaped about the expansion's centre. `model` has all degrees of the expansion,
// which is of the radius, and gradients. Any number of threads gives the same bits.
RadialBound radial_bound(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
                         const RadialModel& model, const BoundOptions& options,
                         const Context& context);

// Returns a bound on all second derivatives along great circles. On a great circle the terms of
// degrees up to l are a trigonometric polynomial of degree l. Its second derivative is at most l^2
// times its largest value (Bernstein). The bounds of bands of degrees are added up. Each band is
// bounded by its values on a grid or by its energies.
double second_derivative_bound(const Coefficients& coefficients, const Context& context);

}  // namespace rholm
