// Sums over scattered directions for each order: the two halves of every direct transform.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// Directions in the layout of the kernels: a structure of arrays, padded to kLegendreLanes.
struct DirectionBlock {
  explicit DirectionBlock(std::span<const Vec3> directions);
  // Takes colatitudes only; longitudes are zero.
  explicit DirectionBlock(std::span<const double> colatitudes);

  std::size_t size = 0;    // number of directions
  std::size_t padded = 0;  // length of each array
  std::vector<double> cos_theta, sin_theta, cos_phi, sin_phi;

 private:
  explicit DirectionBlock(std::size_t n);  // n directions along x, padding set
};

// One complex number per order and direction, [m][padded]; zero beyond the block's size.
struct OrderTable {
  // Fits the table to a block; the entries of its directions keep old values, to be overwritten.
  void reset(int degree, const DirectionBlock& block);
  double* re_row(int m) { return re.data() + static_cast<std::size_t>(m) * padded; }
  double* im_row(int m) { return im.data() + static_cast<std::size_t>(m) * padded; }
  const double* re_row(int m) const { return re.data() + static_cast<std::size_t>(m) * padded; }
  const double* im_row(int m) const { return im.data() + static_cast<std::size_t>(m) * padded; }

  std::size_t padded = 0;
  std::vector<double> re, im;
};

// Returns the number of directions to transform at once. Tables of re and im then have 4 MiB each,
// for any number of threads (chosen: stays in the second and third level cache).
std::size_t chunk_size(int degree);

// Adds to C_lm the sum over j of Pt_lm(theta_j) re[m][j], and to S_lm the sum with im[m][j], for
// l <= sum.degree(). S_l0 does not change.
void add_order_sums(const DirectionBlock& block, const OrderTable& table, Coefficients& sum,
                    const Context& context, const ParallelStage& stage);

// Computes tables[i].re[m][j] = sum_l C^i_lm Pt_lm(theta_j), and im with S^i. There is one table
// per set of coefficients; the 1 or 4 sets have the same degree.
void evaluate_orders(const DirectionBlock& block, std::span<const Coefficients> sets,
                     std::span<OrderTable> tables, const Context& context,
                     const ParallelStage& stage);

}  // namespace rholm
