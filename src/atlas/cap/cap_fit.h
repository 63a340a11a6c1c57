// Least squares of points and normals on one cap. Layer: atlas.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "atlas/cap/cap_limits.h"
#include "atlas/cap/even_moments.h"
#include "atlas/cap/normal_equations.h"
#include "base/aligned_array.h"
#include "rholm/atlas.h"

namespace rholm {

// Points to fit, as arrays that are reused: positions relative to the seed, unit normals, and the
// weights of values (squared, w^2 of method 7.4).
class CapPoints {
 public:
  void clear() { n_ = 0; }
  std::size_t size() const { return n_; }
  std::size_t padded() const { return rholm::padded(n_); }
  void add(const Vec3& offset, const Vec3& normal, double weight);
  // x, y, z of positions, of normals, weight; beyond size() up to padded() zeros.
  const double* row(std::size_t which) const { return data_.data() + which * capacity_; }
  double weight(std::size_t i) const { return row(6)[i]; }
  Vec3 offset(std::size_t i) const { return {row(0)[i], row(1)[i], row(2)[i]}; }
  Vec3 normal(std::size_t i) const { return {row(3)[i], row(4)[i], row(5)[i]}; }
  void pad();  // after the last add()

 private:
  std::size_t n_ = 0, capacity_ = 0;
  AlignedArray<double> data_;
};

// Adds points of weight 1 on a sunflower in the plane of the seed: each stands for the same area of
// the support's disc.
void add_sunflower(const CapFrame& frame, std::size_t n, CapPoints& points);

struct CapFitOptions {
  CapBasis basis = CapBasis::kFull;
  int degree = 3;
  double gradient_weight = 1;  // of normals against values, both in the frame of the opened sphere
  // Of (l (l + 1))^2, relative to the sum of the weights (method 7.4). It differs with the degrees
  // that are fitted: at the highest, (L (L + 1))^2 times it is 3e-5 here (L = 3), 5e-5 for patches
  // of edits (1e-8, L = 8), 9e-5 for few large caps (2e-9, L = 14).
  double penalty = 2e-7;
};

struct CapFit {
  std::vector<double> coefficients;
  double rms = 0;        // of the distances along rays, weighted
  double slope_rms = 0;  // of the differences of slopes, tangents of angles, weighted
  double usable = 0;     // share of the points that face away from the centre
  double deviation = 0;  // largest distance of a point from the tangent plane of the seed
};

// Scratch memory of fits, one per thread.
struct CapFitScratch {
  // [right-hand side, coefficients, residuals][value, slope 1, slope 2][points padded]; of the even
  // basis EvenPoints, then residuals.
  AlignedArray<double> rows;
  EvenMoments moments;
  std::vector<double> matrix;
  NormalFactor factor;
};

// The least squares of a fit before it is solved: points and matrix are in the scratch memory. The
// coefficients of a lower degree are the first ones, so its system is the leading block.
struct CapSystem {
  std::size_t n = 0;       // unknowns
  std::size_t third = 0;   // points, padded
  std::size_t usable = 0;  // points that face away from the centre
  double weights = 0;      // their sum
  bool solvable = false;   // enough points; else there is no matrix
  CapFitOptions options = {};
};
// scratch.matrix is then [n + 1][n + 1] as normal_equations.h has it, penalty included.
CapSystem make_system(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
                      CapFitScratch& scratch);
// That of the same points, in the scratch memory, and another degree: of the even basis.
CapSystem with_degree(const CapSystem& system, int degree, CapFitScratch& scratch);
// What the coefficients of a degree up to the system's leave of the right-hand sides, times the
// points' weights: third values, and with `slopes` as many of both. In the scratch memory.
const double* residuals(const CapSystem& system, std::span<const double> coefficients, bool slopes,
                        CapFitScratch& scratch);

// Fits; false if the matrix is singular to working precision. `points` are padded.
bool fit_cap(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
             CapFitScratch& scratch, CapFit& fit);

}  // namespace rholm
