#include "harmonic/motion/align_newton.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace rholm {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// Makes a[p][q] zero (Golub and Van Loan, section 8.5) and rotates the columns of v.
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
  // Convergence is quadratic: five sweeps reach rounding precision. More cost almost nothing.
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

namespace {

constexpr int kMaxSteps = 40;
// Radians: a quarter wave of degree 8, and the precision that rounding of the gradient allows.
constexpr double kLongestStep = 0.2, kShortestStep = 1e-11;
// Curvatures below this fraction of the largest are noise; steps along their axes are limited.
constexpr double kFlat = 1e-9;

// With Z_m = C_m - i S_m for m > 0 and Z_0 = sqrt2 C_0, lambda_m = sqrt((l-m)(l+m+1)):
//   L_x Z_m = (i/2) (lambda_{m-1} Z_{m-1} + lambda_m Z_{m+1}),    L_x C_0 = lambda_0 S_1 / sqrt2.
//   L_y Z_m = (1/2) (lambda_{m-1} Z_{m-1} - lambda_m Z_{m+1}),    L_y C_0 = -lambda_0 C_1 / sqrt2.
//   L_z Z_m = -i m Z_m.
void derivatives_of_degree(const Coefficients& f, int l, std::array<Coefficients, 3>& result) {
  using Complex = std::complex<double>;
  const auto z = [&](int m) {
    return m == 0 ? Complex(std::numbers::sqrt2 * f.c(l, 0)) : Complex(f.c(l, m), -f.s(l, m));
  };
  const auto lambda = [&](int m) { return std::sqrt((l - m) * (l + m + 1.0)); };
  result[0].c(l, 0) = lambda(0) * f.s(l, 1) / std::numbers::sqrt2;
  result[1].c(l, 0) = -lambda(0) * f.c(l, 1) / std::numbers::sqrt2;
  for (int m = 1; m <= l; ++m) {
    const Complex below = lambda(m - 1) * z(m - 1);
    const Complex above = m < l ? lambda(m) * z(m + 1) : Complex(0);
    const Complex parts[3] = {Complex(0, 0.5) * (below + above), 0.5 * (below - above),
                              Complex(0, -m) * z(m)};
    for (int k = 0; k < 3; ++k) {
      result[k].c(l, m) = parts[k].real();
      result[k].s(l, m) = -parts[k].imag();
    }
  }
}

Vec3 newton_step(const Vec3& gradient, const Eigen3& curvature) {
  double largest = 0;
  for (const double value : curvature.values) largest = std::max(largest, std::abs(value));
  Vec3 step;
  for (int i = 0; i < 3; ++i) {
    // The absolute value makes the step go uphill where the curvature has the wrong sign, too.
    const double bend = std::max(std::abs(curvature.values[i]), kFlat * largest);
    if (bend > 0) step += dot(gradient, curvature.vectors[i]) / bend * curvature.vectors[i];
  }
  const double length = norm(step);
  return length > kLongestStep ? kLongestStep / length * step : step;
}

Rotation stepped(const Vec3& step, const Rotation& from) {
  const double length = norm(step);
  return length > 0 ? compose(rotation_about(step, length), from) : from;
}

}  // namespace

std::array<Coefficients, 3> rotation_derivatives(const Coefficients& f) {
  std::array<Coefficients, 3> result;
  result.fill(Coefficients(f.degree()));
  for (int l = 1; l <= f.degree(); ++l) derivatives_of_degree(f, l, result);
  return result;
}

double correlation(const Coefficients& a, const Coefficients& b) {
  double sum = 0;
  for (int l = 1; l <= a.degree(); ++l) {
    double of_degree = 0;
    for (int m = 0; m <= l; ++m) of_degree += a.c(l, m) * b.c(l, m) + a.s(l, m) * b.s(l, m);
    sum += of_degree;
  }
  return sum;
}

CorrelationMaximum refine_rotation(const Coefficients& a, const Coefficients& b,
                                   const Rotation& start, const Context& context) {
  const auto of_b = rotation_derivatives(b);
  CorrelationMaximum best{.rotation = start, .value = 0, .curvature = {}};
  Coefficients turned = rotate(a, start, context);
  best.value = correlation(turned, b);
  for (int n = 0; n < kMaxSteps; ++n) {
    const auto of_a = rotation_derivatives(turned);
    std::array<std::array<double, 3>, 3> bend{};
    for (int j = 0; j < 3; ++j) {
      for (int k = j; k < 3; ++k) {
        bend[j][k] = (correlation(of_a[j], of_b[k]) + correlation(of_a[k], of_b[j])) / 2;
      }
    }
    const Vec3 gradient = {correlation(of_a[0], b), correlation(of_a[1], b),
                           correlation(of_a[2], b)};
    best.curvature = eigen_of_symmetric(bend);
    Vec3 step = newton_step(gradient, best.curvature);
    bool higher = false;
    for (; norm(step) > kShortestStep && !higher; step *= 0.5) {
      const Rotation next = stepped(step, best.rotation);
      Coefficients there = rotate(a, next, context);
      const double value = correlation(there, b);
      if (value > best.value) {
        best.rotation = next;
        best.value = value;
        turned = std::move(there);
        higher = true;
      } else if (norm(step) < 1e-7) {
        return best;  // further steps change the correlation by less than rounding
      }
    }
    if (!higher) return best;
  }
  return best;
}

}  // namespace rholm
