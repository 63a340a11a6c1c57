// The correlation <R a, b> near a rotation: gradient, Hessian and Newton's iteration to a maximum.
//
// With the antisymmetric derivative L_k of a rotation about axis k at angle 0, and the rotation
// exp(w . L) by |w| about w:
//   d/dw_k <exp(w.L) R a, b> = <L_k R a, b>,    d2/dw_j dw_k = -<L_j R a, L_k b>, symmetrised.
#pragma once

#include <array>
#include <vector>

#include "rholm/context.h"
#include "rholm/rotate.h"
#include "rholm/vec3.h"

namespace rholm {

// Eigenvalues and eigenvectors of a symmetric 3 x 3 matrix.
struct Eigen3 {
  std::array<double, 3> values;  // descending
  std::array<Vec3, 3> vectors;   // orthonormal, right-handed
};

// Decomposes the matrix with rows[i][k] by Jacobi's rotations; reads only i <= k.
Eigen3 eigen_of_symmetric(const std::array<std::array<double, 3>, 3>& rows);

// Returns L_k f for k = x, y, z.
std::array<Coefficients, 3> rotation_derivatives(const Coefficients& f);

// Returns the sum of products over degrees 1 ... L; a and b have the same degree.
double correlation(const Coefficients& a, const Coefficients& b);

struct CorrelationMaximum {
  Rotation rotation;
  double value = 0;  // <R a, b>
  Eigen3 curvature;  // negative Hessian, with axes in the frame of b
};

// Returns the maximum uphill from `start`; a and b have the same degree.
CorrelationMaximum refine_rotation(const Coefficients& a, const Coefficients& b,
                                   const Rotation& start, const Context& context);

}  // namespace rholm
