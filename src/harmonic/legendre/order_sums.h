// Sums over scattered directions, order by order: the two halves of every direct transform.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// Directions as the kernels want them: structure of arrays, padded to kLegendreLanes.
struct DirectionBlock {
  explicit DirectionBlock(std::span<const Vec3> directions);
  // Colatitudes alone; longitudes are zero.
  explicit DirectionBlock(std::span<const double> colatitudes);

  std::size_t size = 0;    // directions
  std::size_t padded = 0;  // array lengths
  std::vector<double> cos_theta, sin_theta, cos_phi, sin_phi;

 private:
  explicit DirectionBlock(std::size_t n);  // n directions along x, padding set
};

// One complex number per order and direction, [m][padded]: zero beyond the block's size.
struct OrderTable {
  // Fits the table to a block; entries of its directions are left as they are, to be overwritten.
  void reset(int degree, const DirectionBlock& block);
  double* re_row(int m) { return re.data() + static_cast<std::size_t>(m) * padded; }
  double* im_row(int m) { return im.data() + static_cast<std::size_t>(m) * padded; }
  const double* re_row(int m) const { return re.data() + static_cast<std::size_t>(m) * padded; }
  const double* im_row(int m) const { return im.data() + static_cast<std::size_t>(m) * padded; }

  std::size_t padded = 0;
  std::vector<double> re, im;
};

// How many directions are worked on at once: a table of 4 MiB for each of re and im (chosen: stays
// in the second and third level cache), whatever the number of threads.
std::size_t chunk_size(int degree);

// C_lm += sum_j Pt_lm(theta_j) re[m][j], S_lm += sum_j Pt_lm(theta_j) im[m][j], for
// l <= sum.degree(). S_l0 is left alone.
void add_order_sums(const DirectionBlock& block, const OrderTable& table, Coefficients& sum,
                    const Context& context, const ParallelStage& stage);

// tables[i].re[m][j] = sum_l C^i_lm Pt_lm(theta_j), im with S^i: one table per set of
// coefficients, all of the same degree; 1 or 4 sets.
void evaluate_orders(const DirectionBlock& block, std::span<const Coefficients> sets,
                     std::span<OrderTable> tables, const Context& context,
                     const ParallelStage& stage);

}  // namespace rholm
