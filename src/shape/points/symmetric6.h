// Positive definite matrices of six unknowns: paraboloids, rigid motions. Layer: shape.
#pragma once

#include <array>
#include <cmath>

namespace rholm {

inline constexpr int kSix = 6;
using Vector6 = std::array<double, kSix>;
using Matrix6 = std::array<Vector6, kSix>;

// The Cholesky factor in the place of the lower triangle, all that is read; false if the matrix is
// not positive definite.
inline bool factorize(Matrix6& a) {
  for (int i = 0; i < kSix; ++i) {
    const double diagonal = a[i][i];
    for (int j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (int k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      if (i != j) {
        a[i][j] = sum / a[j][j];
      } else {
        // Below this share of the diagonal nothing but rounding of some 30 sums is left.
        if (!(sum > 1e-12 * diagonal)) return false;
        a[i][i] = std::sqrt(sum);
      }
    }
  }
  return true;
}

// b becomes the solution; `factor` is factorize()'s.
inline void solve(const Matrix6& factor, Vector6& b) {
  for (int i = 0; i < kSix; ++i) {
    for (int k = 0; k < i; ++k) b[i] -= factor[i][k] * b[k];
    b[i] /= factor[i][i];
  }
  for (int i = kSix - 1; i >= 0; --i) {
    for (int k = i + 1; k < kSix; ++k) b[i] -= factor[k][i] * b[k];
    b[i] /= factor[i][i];
  }
}

}  // namespace rholm
