// Solves a linear program in four unknowns whose rows arrive in rounds.
//
// Source: the dual simplex method with the lexicographic rule against cycling (Dantzig, Orden,
// Wolfe 1955). The basis consists of four rows. Each step takes in the row that is violated most.
// It inverts the basis's 4 x 4 matrix afresh, so that rounding does not build up.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "rholm/vec3.h"

namespace rholm {

// The constraint a . c + lift * t <= bound.
struct Row {
  Vec3 a;
  double lift = 1;
  double bound = 0;
  double rounding = 0;  // rounding error of the row; solve(true) uses it
};

// Maximises t over (c, t) with |c_k| <= reach, t <= most and the added rows. Among equal optima it
// finds the one with the largest c.x, then c.y, then c.z. If lift > 0 in every row, a solution
// always exists. Coefficients should be near 1 in modulus.
class LinearProgram {
 public:
  LinearProgram(double reach, double most);
  void add(const Row& row) { rows_.push_back(row); }
  // Continues from the last basis. Returns false at the limit of steps, or if the next step
  // would make the basis singular within rounding. Then center() and top() are the values of
  // the last good basis, and top() is still an upper bound. With `roughly`, rows may be
  // violated by their rounding.
  bool solve(bool roughly = false);

  const Vec3& center() const { return center_; }
  double top() const { return top_; }  // the largest t
  // Rows that hold the optimum, and their weights. Weights are >= 0, and the sum of weight *
  // (a, lift) is (0, 0, 0, 1).
  const std::array<std::size_t, 4>& basis() const { return basis_; }
  const std::array<double, 4>& weights() const { return weights_; }
  const std::vector<Row>& rows() const { return rows_; }

 private:
  using Matrix = std::array<std::array<double, 4>, 4>;
  bool invert_basis(Matrix& inverse) const;
  void evaluate(const Matrix& inverse);

  std::vector<Row> rows_;
  std::array<std::size_t, 4> basis_;
  std::array<double, 4> weights_ = {};
  Vec3 center_;
  double top_ = 0;
};

}  // namespace rholm
