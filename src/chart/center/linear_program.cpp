#include "chart/center/linear_program.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rholm {
namespace {

using Vector = std::array<double, 4>;
using Matrix = std::array<Vector, 4>;

// Largest violation of a satisfied row. Coordinates of the solution are known to about 2^-50 when
// the basis is well conditioned.
constexpr double kViolation = 1e-14;
// Smallest pivot. Chosen: a smaller one would leave a basis that loses half of the digits.
constexpr double kSmallestPivot = 1e-9;
// Ratios that differ by less are equal; then the next component of the lexicographic rule decides.
constexpr double kRatioRounding = 1e-13;
// Limit of steps, only a guard against rounding; 5 to 40 steps are usual.
constexpr int kMaxSteps = 2000;

Vector coefficients(const Row& row) { return {row.a.x, row.a.y, row.a.z, row.lift}; }

// Inverts by Gauss-Jordan with partial pivoting; returns false if m is singular to rounding.
bool invert(Matrix m, Matrix& inverse) {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) inverse[i][j] = i == j;
  }
  for (int k = 0; k < 4; ++k) {
    int pivot = k;
    for (int i = k + 1; i < 4; ++i) {
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    }
    if (std::abs(m[pivot][k]) < 1e-15) return false;
    std::swap(m[k], m[pivot]);
    std::swap(inverse[k], inverse[pivot]);
    const double factor = 1 / m[k][k];
    for (int j = 0; j < 4; ++j) {
      m[k][j] *= factor;
      inverse[k][j] *= factor;
    }
    for (int i = 0; i < 4; ++i) {
      if (i == k) continue;
      const double f = m[i][k];
      for (int j = 0; j < 4; ++j) {
        m[i][j] -= f * m[k][j];
        inverse[i][j] -= f * inverse[k][j];
      }
    }
  }
  return true;
}

// Returns the weight of basis row i for the objective g = (t, eps c.x, eps^2 c.y, eps^3 c.z). This
// is row i of the transposed inverse, with its components in the order of g.
Vector lexicographic_weight(const Matrix& inverse, int i) {
  return {inverse[3][i], inverse[0][i], inverse[1][i], inverse[2][i]};
}

// Returns the basis row that leaves for an entering row with coordinates y in the basis. Its weight
// divided by y is lexicographically smallest; -1 if no row can leave.
int leaving_row(const Matrix& inverse, const Vector& y) {
  int best = -1;
  Vector best_ratio{};
  for (int i = 0; i < 4; ++i) {
    if (y[i] < kSmallestPivot) continue;
    Vector ratio = lexicographic_weight(inverse, i);
    for (double& r : ratio) r /= y[i];
    bool smaller = best < 0;
    for (int k = 0; k < 4 && !smaller && best >= 0; ++k) {
      const double slack = kRatioRounding * (1 + std::abs(best_ratio[k]));
      if (ratio[k] < best_ratio[k] - slack) smaller = true;
      if (ratio[k] > best_ratio[k] + slack) break;
    }
    if (smaller) {
      best = i;
      best_ratio = ratio;
    }
  }
  return best;
}

}  // namespace

LinearProgram::LinearProgram(double reach, double most) {
  for (const Vec3& a : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}) {
    rows_.push_back({.a = a, .lift = 0, .bound = reach});
  }
  rows_.push_back({.a = {}, .lift = 1, .bound = most});
  basis_ = {0, 1, 2, 6};
}

bool LinearProgram::invert_basis(Matrix& inverse) const {
  Matrix matrix;
  for (int i = 0; i < 4; ++i) matrix[i] = coefficients(rows_[basis_[i]]);
  return invert(matrix, inverse);
}

void LinearProgram::evaluate(const Matrix& inverse) {
  Vector x{};
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 4; ++i) x[k] += inverse[k][i] * rows_[basis_[i]].bound;
    weights_[k] = inverse[3][k];
  }
  center_ = {x[0], x[1], x[2]};
  top_ = x[3];
}

bool LinearProgram::solve(bool roughly) {
  Matrix inverse;
  if (!invert_basis(inverse)) return false;
  evaluate(inverse);
  for (int step = 0; step < kMaxSteps; ++step) {
    double worst = kViolation;
    std::size_t entering = rows_.size();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      double excess = dot(rows_[i].a, center_) + rows_[i].lift * top_ - rows_[i].bound;
      if (roughly) excess -= rows_[i].rounding;
      if (excess > worst) {
        worst = excess;
        entering = i;
      }
    }
    if (entering == rows_.size()) return true;
    const Vector a = coefficients(rows_[entering]);
    Vector y{};
    for (int i = 0; i < 4; ++i) {
      for (int k = 0; k < 4; ++k) y[i] += inverse[k][i] * a[k];
    }
    const int leaving = leaving_row(inverse, y);
    if (leaving < 0) return false;
    const std::size_t left = std::exchange(basis_[leaving], entering);
    Matrix next;
    if (!invert_basis(next)) {
      basis_[leaving] = left;
      return false;
    }
    inverse = next;
    evaluate(inverse);
  }
  return false;
}

}  // namespace rholm
