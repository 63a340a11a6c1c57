// An upper bound of the radial error of an expansion over the whole surface, by branch and bound:
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
  double seen = 0;             // the error at no vertex is larger
  double enough = 0;           // parts of faces whose bound is no larger are not divided
  double doubt = 0;            // of the model's values, in the mesh's unit
  std::size_t most_cells = 0;  // at which errors are computed, about
};
struct RadialBound {
  double value = 0;       // no error is larger; infinite where nothing can be said
  std::size_t cells = 0;  // at which errors were computed
};
// Of a star-shaped mesh about the expansion's centre. `model`: all degrees of the expansion, which
// is one of the radius, with gradients. The same bits for any number of threads.
RadialBound radial_bound(const MeshView& mesh, const FaceScan& scan, const Expansion& expansion,
                         const RadialModel& model, const BoundOptions& options,
                         const Context& context);

// No second derivative along a great circle is larger. On a great circle the terms of degrees up to
// l are a trigonometric polynomial of that degree, whose second derivative is at most l^2 times its
// largest value (Bernstein). Bands of degrees are added up, each bounded by its values on a grid or
// by its energies.
double second_derivative_bound(const Coefficients& coefficients, const Context& context);

}  // namespace rholm
