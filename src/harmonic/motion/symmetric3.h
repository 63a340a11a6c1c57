// Eigenvectors of symmetric 3 x 3 matrices.
#pragma once

#include <array>

#include "rholm/vec3.h"

namespace rholm {

struct Eigen3 {
  std::array<double, 3> values;  // descending
  std::array<Vec3, 3> vectors;   // orthonormal, right-handed
};

// Of the matrix with rows[i][k]; only i <= k is read. By Jacobi's rotations.
Eigen3 eigen_of_symmetric(const std::array<std::array<double, 3>, 3>& rows);

}  // namespace rholm
