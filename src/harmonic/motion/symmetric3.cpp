#include "harmonic/motion/symmetric3.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rholm {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// Makes a[p][q] zero (Golub and Van Loan, section 8.5); columns of v turn along.
void jacobi_step(Matrix& a, Matrix& v, int p, int q) {
  if (a[p][q] == 0) return;
  const double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double t = (theta < 0 ? -1 : 1) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0), s = t * c;
  for (int k = 0; k < 3; ++k) {
    const double x = a[k][p], y = a[k][q];
    a[k][p] = c * x - s * y;
    a[k][q] = s * x + c * y;
  }
  for (int k = 0; k < 3; ++k) {
    const double x = a[p][k], y = a[q][k];
    a[p][k] = c * x - s * y;
    a[q][k] = s * x + c * y;
  }
  for (int k = 0; k < 3; ++k) {
    const double x = v[k][p], y = v[k][q];
    v[k][p] = c * x - s * y;
    v[k][q] = s * x + c * y;
  }
  a[p][q] = a[q][p] = 0;
}

}  // namespace

Eigen3 eigen_of_symmetric(const Matrix& rows) {
  Matrix a = rows, v = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < i; ++k) a[i][k] = a[k][i];
  }
  // Convergence is quadratic: five sweeps reach rounding, the rest costs nothing then.
  for (int sweep = 0; sweep < 12; ++sweep) {
    jacobi_step(a, v, 0, 1);
    jacobi_step(a, v, 0, 2);
    jacobi_step(a, v, 1, 2);
  }
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int i, int k) { return a[i][i] > a[k][k]; });
  Eigen3 result;
  for (int i = 0; i < 3; ++i) {
    const int column = order[i];
    result.values[i] = a[column][column];
    result.vectors[i] = {v[0][column], v[1][column], v[2][column]};
  }
  result.vectors[2] = cross(result.vectors[0], result.vectors[1]);
  return result;
}

}  // namespace rholm
