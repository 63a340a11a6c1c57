#include "atlas/cap/degree_fits.h"

#include <cmath>

namespace rholm {
namespace {

constexpr double kSingular = 1e-13;  // pivots below that part of the diagonal are rounding

}  // namespace

// By columns, the matrix bordered by the right-hand side as a last row, so that the forward
// substitution comes with the factor; inner loops add multiples of columns.
void DegreeFits::factor(const CapSystem& system, const std::vector<double>& matrix) {
  const std::size_t n = system.n, m = n + 1;
  stride_ = m;
  columns_.resize(n * m);
  forward_.resize(n);
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < m; ++i) columns_[j * m + i] = matrix[i * m + j];
  }
  for (regular_ = 0; regular_ < n; ++regular_) {
    const std::size_t j = regular_;
    double* const column = &columns_[j * m];
    const double diagonal = column[j];
    for (std::size_t k = 0; k < j; ++k) {
      const double* const left = &columns_[k * m];
      const double factor = left[j];
      for (std::size_t i = j; i < m; ++i) column[i] -= factor * left[i];
    }
    if (!(column[j] > kSingular * diagonal)) return;
    const double inverse = 1 / std::sqrt(column[j]);
    for (std::size_t i = j; i < m; ++i) column[i] *= inverse;
    forward_[j] = column[n];
  }
}

void DegreeFits::solve(std::size_t n, std::vector<double>& coefficients) const {
  coefficients.assign(forward_.begin(), forward_.begin() + static_cast<std::ptrdiff_t>(n));
  for (std::size_t j = n; j-- > 0;) {
    const double* const column = &columns_[j * stride_];
    double sum = coefficients[j];
    for (std::size_t i = j + 1; i < n; ++i) sum -= column[i] * coefficients[i];
    coefficients[j] = sum / column[j];
  }
}

// Column after column: L L^T x = e_j.
void DegreeFits::invert(std::size_t n, std::vector<double>& inverse) const {
  inverse.assign(n * n, 0);
  for (std::size_t j = 0; j < n; ++j) {
    double* const x = &inverse[j * n];
    x[j] = 1;
    for (std::size_t k = j; k < n; ++k) {
      const double* const column = &columns_[k * stride_];
      x[k] /= column[k];
      for (std::size_t i = k + 1; i < n; ++i) x[i] -= column[i] * x[k];
    }
    for (std::size_t k = n; k-- > 0;) {
      const double* const column = &columns_[k * stride_];
      double sum = x[k];
      for (std::size_t i = k + 1; i < n; ++i) sum -= column[i] * x[i];
      x[k] = sum / column[k];
    }
  }
}

}  // namespace rholm
