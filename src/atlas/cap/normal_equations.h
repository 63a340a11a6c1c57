// Least squares by their normal equations: made from rows, factored, solved. Layer: atlas.
//
// One order everywhere: row 0 is the right-hand side, row 1 + k what stands by unknown k. The
// matrix of all products of two rows, [n + 1][n + 1] by rows, counts on its diagonal and to the
// right of it: row 0 holds b^T b and A^T b, what is left is the normal matrix A^T A. So rows and
// matrix of the first unknowns alone are the leading ones.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atlas/cap/cap_limits.h"
#include "base/aligned_array.h"

namespace rholm {

struct NormalRows {
  const double* rows = nullptr;     // readable up to a multiple of four rows: clear_beyond()
  std::size_t count = 0;            // with the right-hand side
  std::size_t length = 0;           // of a row, a multiple of kCapLanes
  std::size_t stride = 0;           // from one row to the next
  const double* weights = nullptr;  // of the products, `length` of them; 1 if there are none
};

// Zeros in the rows from `count` up to a multiple of four. They are multiplied with the others,
// and nothing comes of it; but denormal numbers that lay there make that three times slower.
void clear_beyond(double* rows, std::size_t count, std::size_t stride);

// The matrix of their products, set or added to `matrix`, [count][count].
void make_normal_matrix(const NormalRows& rows, double* matrix);
void add_normal_matrix(const NormalRows& rows, double* matrix);

// The place of unknown k's diagonal element in the matrix of n unknowns.
constexpr std::size_t normal_diagonal(std::size_t k, std::size_t n) { return (1 + k) * (n + 2); }

// Cholesky's factors of a normal matrix without roots, and with them the right-hand side: A^T A =
// R^T D^-1 R with R upper triangular and D its diagonal, the pivots; R x = D R^-T A^T b. Leading
// blocks are the factors of leading blocks, so that solutions of fewer unknowns cost a back
// substitution only. To be used again: it keeps its memory.
class NormalFactor {
 public:
  // Factors as many leading unknowns of `matrix` (of n) as are regular, and returns how many: up to
  // the first whose pivot, what the unknowns before it leave of its diagonal element, is no more
  // than the part `least` of that, or no normal number.
  std::size_t factor(const double* matrix, std::size_t n, double least);
  std::size_t regular() const { return regular_; }

  // The first n <= regular() unknowns, solved without the others.
  void solve(std::size_t n, std::vector<double>& x) const;

  // The same of several n, ascending: one solution after the other, each as long as the last, with
  // zeros behind its own unknowns.
  void solve_nested(std::span<const std::size_t> sizes, std::vector<double>& x);

  // The inverse [n][n] of the leading block, n <= regular(), symmetric to the last bit.
  void invert(std::size_t n, std::vector<double>& inverse);

 private:
  double* work(std::size_t size);  // that holds anything

  std::size_t n_ = 0, regular_ = 0;
  AlignedArray<double> upper_;  // R [n_][padded(n_ + 1)], D R^-T A^T b in column n_
  AlignedArray<double> work_;
};

}  // namespace rholm
