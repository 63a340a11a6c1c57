// Makes normal equations of least squares from rows, factors and solves them. Layer: atlas.
//
// Row 0 is always the right-hand side, and row 1 + k belongs to unknown k. The matrix of all
// products of two rows, [n + 1][n + 1] by rows, counts on and right of its diagonal. Its row 0
// holds b^T b and A^T b, the other rows the normal matrix A^T A. So the rows and the matrix of
// the first unknowns alone are the leading ones.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atlas/cap/cap_limits.h"
#include "base/aligned_array.h"

namespace rholm {

struct NormalRows {
  const double* rows = nullptr;     // readable up to a multiple of four rows: clear_beyond()
  std::size_t count = 0;            // number of rows, with the right-hand side
  std::size_t length = 0;           // length of a row, a multiple of kCapLanes
  std::size_t stride = 0;           // distance from one row to the next
  const double* weights = nullptr;  // weights of the products, `length` of them; nullptr: 1
};

// Sets the rows from `count` up to a multiple of four to zero. They are multiplied with the
// others without effect, but denormal numbers in them would make this three times slower.
void clear_beyond(double* rows, std::size_t count, std::size_t stride);

// Set `matrix` to the products of the rows, or add the products; [count][count].
void make_normal_matrix(const NormalRows& rows, double* matrix);
void add_normal_matrix(const NormalRows& rows, double* matrix);

// Returns the index of unknown k's diagonal element in the matrix of n unknowns.
constexpr std::size_t normal_diagonal(std::size_t k, std::size_t n) { return (1 + k) * (n + 2); }

// Factors a normal matrix (Cholesky without roots) together with the right-hand
// side: A^T A = R^T D^-1 R with R upper triangular and D its diagonal, the pivots;
// R x = D R^-T A^T b. Leading blocks are factors of leading blocks, so fewer
// unknowns cost only a back substitution. The object keeps its memory for reuse.
class NormalFactor {
 public:
  // Factors the longest regular leading block of `matrix` (of n unknowns), and returns its size.
  // The block ends before the first pivot that is at most `least` times its diagonal element, or
  // not a normal number. A pivot is the diagonal element minus the part of the earlier unknowns.
  std::size_t factor(const double* matrix, std::size_t n, double least);
  std::size_t regular() const { return regular_; }

  // Solves for the first n <= regular() unknowns, without the other unknowns.
  void solve(std::size_t n, std::vector<double>& x) const;

  // Does so for several ascending n. The solutions follow each other,
  // each as long as the last one, with zeros after its own unknowns.
  void solve_nested(std::span<const std::size_t> sizes, std::vector<double>& x);

  // Computes the inverse [n][n] of the leading block, n <= regular(); exactly symmetric.
  void invert(std::size_t n, std::vector<double>& inverse);

 private:
  double* work(std::size_t size);  // returns memory with arbitrary content

  std::size_t n_ = 0, regular_ = 0;
  AlignedArray<double> upper_;  // R [n_][padded(n_ + 1)], D R^-T A^T b in column n_
  AlignedArray<double> work_;
};

}  // namespace rholm
