// Fits of one cap at all degrees from one matrix (method 7.8). Layer: atlas.
#pragma once

#include <cstddef>
#include <vector>

#include "atlas/cap/cap_fit.h"

namespace rholm {

// The normal matrix of a system, factored: the factor's leading blocks are those of the leading
// blocks, so each degree costs a back substitution only.
class DegreeFits {
 public:
  // Factors as many leading rows as are regular to working precision.
  void factor(const CapSystem& system, const std::vector<double>& matrix);
  std::size_t regular() const { return regular_; }
  // The first n <= regular() coefficients, fitted without the others.
  void solve(std::size_t n, std::vector<double>& coefficients) const;
  // The inverse [n][n] of the leading block.
  void invert(std::size_t n, std::vector<double>& inverse) const;

 private:
  std::size_t regular_ = 0, stride_ = 0;
  std::vector<double> columns_;  // the factor, column after column
  std::vector<double> forward_;  // factor^-1 right-hand side
};

}  // namespace rholm
