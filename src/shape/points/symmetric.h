// Computes eigenvalues of symmetric 3 x 3 matrices, and solves positive definite systems of six
// unknowns (paraboloids, rigid motions). Layer: shape.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace rholm {

struct Symmetric3 {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

struct Eigenvalues {
  double least = 0, middle = 0, largest = 0;
};

// Uses the trigonometric solution of the cubic (Smith 1961). Errors are some 1e-8 of the largest
// eigenvalue if the two smaller ones are nearly equal, and a few ulp otherwise.
inline Eigenvalues eigenvalues(const Symmetric3& m) {
  const double mean = (m.xx + m.yy + m.zz) / 3;
  const double x = m.xx - mean, y = m.yy - mean, z = m.zz - mean;
  const double off = m.xy * m.xy + m.xz * m.xz + m.yz * m.yz;
  const double p = std::sqrt((x * x + y * y + z * z + 2 * off) / 6);
  const double determinant =
      x * (y * z - m.yz * m.yz) - m.xy * (m.xy * z - m.yz * m.xz) + m.xz * (m.xy * m.yz - y * m.xz);
  const double p3 = p * p * p;
  if (!(p3 > 0)) return {mean, mean, mean};
  const double angle = std::acos(std::clamp(determinant / (2 * p3), -1.0, 1.0)) / 3;
  const double least = mean + 2 * p * std::cos(angle + 2 * std::numbers::pi / 3);
  const double largest = mean + 2 * p * std::cos(angle);
  return {least, 3 * mean - least - largest, largest};
}

inline constexpr int kSix = 6;
using Vector6 = std::array<double, kSix>;
using Matrix6 = std::array<Vector6, kSix>;

// Replaces the lower triangle, the only part that is read, by the Cholesky factor. Returns false if
// the matrix is not positive definite.
inline bool factorize(Matrix6& a) {
  for (int i = 0; i < kSix; ++i) {
    const double diagonal = a[i][i];
    for (int j = 0; j <= i; ++j) {
      double sum = a[i][j];
      for (int k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      if (i != j) {
        a[i][j] = sum / a[j][j];
      } else {
        // Below this share of the diagonal, only rounding of some 30 sums is left.
        if (!(sum > 1e-12 * diagonal)) return false;
        a[i][i] = std::sqrt(sum);
      }
    }
  }
  return true;
}

// Replaces b by the solution; `factor` is the result of factorize().
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
