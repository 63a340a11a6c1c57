// The correlation <R a, b> near a rotation: gradient, Hessian, and Newton's way to its maximum.
//
// With L_k the derivative of a rotation about axis k at angle 0, antisymmetric, and exp(w . L) the
// rotation by |w| about w:
//   d/dw_k <exp(w.L) R a, b> = <L_k R a, b>,    d2/dw_j dw_k = -<L_j R a, L_k b>, symmetrised.
#pragma once

#include <array>
#include <vector>

#include "rholm/context.h"
#include "rholm/rotate.h"
#include "rholm/vec3.h"

namespace rholm {

// Eigenvectors of a symmetric 3 x 3 matrix.
struct Eigen3 {
  std::array<double, 3> values;  // descending
  std::array<Vec3, 3> vectors;   // orthonormal, right-handed
};

// Of the matrix with rows[i][k]; only i <= k is read. By Jacobi's rotations.
Eigen3 eigen_of_symmetric(const std::array<std::array<double, 3>, 3>& rows);

// L_k f, k = x, y, z.
std::array<Coefficients, 3> rotation_derivatives(const Coefficients& f);

// sum of products over degrees 1 ... L, both of one degree.
double correlation(const Coefficients& a, const Coefficients& b);

struct CorrelationMaximum {
  Rotation rotation;
  double value = 0;  // <R a, b>
  Eigen3 curvature;  // of minus the Hessian: axes in the frame of b, values descending
};

// The maximum uphill from `start`; a and b of one degree.
CorrelationMaximum refine_rotation(const Coefficients& a, const Coefficients& b,
                                   const Rotation& start, const Context& context);

}  // namespace rholm
