// A linear program in four unknowns, with many rows that arrive in rounds.
//
// Source: the dual simplex method with the lexicographic rule against cycling (Dantzig, Orden,
// Wolfe 1955). The basis is four rows; each step inverts its 4 x 4 matrix afresh, so that rounding
// does not build up, and takes in the row that is violated most.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "rholm/vec3.h"

namespace rholm {

// a . c + lift * t <= bound
struct Row {
  Vec3 a;
  double lift = 1;
  double bound = 0;
  double rounding = 0;  // how far off it may be, if that matters
};

// Maximises t over (c, t) with |c_k| <= reach, t <= most and the rows added; among equal optima the
// one with the largest c.x, then c.y, then c.z. With lift > 0 in every row there is always a
// solution. Coefficients should be near 1 in modulus.
class LinearProgram {
 public:
  LinearProgram(double reach, double most);
  void add(const Row& row) { rows_.push_back(row); }
  // From the last basis on. Returns false if the limit of steps was met, or only rows that are
  // violated within rounding are left out of a basis that is all but singular; `center` and `top`
  // are then those of the last good basis, and `top` still is an upper bound. With `roughly` rows
  // that are violated by no more than their rounding are satisfied.
  bool solve(bool roughly = false);

  const Vec3& center() const { return center_; }
  double top() const { return top_; }  // the largest t
  // The rows that hold the optimum, and their weights: weights >= 0, sum of weight * (a, lift) =
  // (0, 0, 0, 1).
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
