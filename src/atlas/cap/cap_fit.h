// Fits one cap to points and normals by least squares. Layer: atlas.
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

// Points to fit, in reusable arrays: positions relative to the seed,
// unit normals, and the weights of values (squared, w^2 of method 7.4).
class CapPoints {
 public:
  void clear() { n_ = 0; }
  std::size_t size() const { return n_; }
  std::size_t padded() const { return rholm::padded(n_); }
  void add(const Vec3& offset, const Vec3& normal, double weight);
  // Rows: x, y, z of positions, x, y, z of normals, weight; zero from size() to padded().
  const double* row(std::size_t which) const { return data_.data() + which * capacity_; }
  double weight(std::size_t i) const { return row(6)[i]; }
  Vec3 offset(std::size_t i) const { return {row(0)[i], row(1)[i], row(2)[i]}; }
  Vec3 normal(std::size_t i) const { return {row(3)[i], row(4)[i], row(5)[i]}; }
  void pad();  // call after the last add()

 private:
  std::size_t n_ = 0, capacity_ = 0;
  AlignedArray<double> data_;
};

// Adds points of weight 1 in a sunflower pattern in the plane of
// the seed; each represents the same area of the support's disc.
void add_sunflower(const CapFrame& frame, std::size_t n, CapPoints& points);

struct CapFitOptions {
  CapBasis basis = CapBasis::kFull;
  int degree = 3;
  double gradient_weight = 1;  // weight of normals relative to values, on the opened sphere
  // Factor of (l (l + 1))^2, relative to the sum of the weights (method 7.4). It
  // depends on the degree. Its product with (L (L + 1))^2 is 3e-5 here (L = 3),
  // 5e-5 for patches of edits (1e-8, L = 8), 9e-5 for large caps (2e-9, L = 14).
  double penalty = 2e-7;
};

struct CapFit {
  std::vector<double> coefficients;
  double rms = 0;        // weighted rms of the distances along rays
  double slope_rms = 0;  // weighted rms of the slope differences (tangents of angles)
  double usable = 0;     // share of the points that face away from the centre
  double deviation = 0;  // largest distance of a point from the tangent plane of the seed
};

// Scratch memory of fits, one per thread.
struct CapFitScratch {
  // Full basis: [right-hand side, coefficients, residuals][value, slope
  // 1, slope 2][points padded]. Even basis: EvenPoints, then residuals.
  AlignedArray<double> rows;
  EvenMoments moments;
  std::vector<double> matrix;
  NormalFactor factor;
};

// Least-squares system before it is solved; points and matrix are in the scratch memory.
// The coefficients of a lower degree come first, so its system is the leading block.
struct CapSystem {
  std::size_t n = 0;       // number of unknowns
  std::size_t third = 0;   // number of points, padded
  std::size_t usable = 0;  // number of points that face away from the centre
  double weights = 0;      // sum of the weights
  bool solvable = false;   // true if there are enough points; without them there is no matrix
  CapFitOptions options = {};
};
// Makes the system. scratch.matrix becomes [n + 1][n + 1] (normal_equations.h), with penalty.
CapSystem make_system(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
                      CapFitScratch& scratch);
// Makes the system of another degree from the same points in the scratch memory; even basis.
CapSystem with_degree(const CapSystem& system, int degree, CapFitScratch& scratch);
// Returns weighted residuals of coefficients up to the system's degree: `third` values,
// and with `slopes` also `third` of each slope. The result lies in the scratch memory.
const double* residuals(const CapSystem& system, std::span<const double> coefficients, bool slopes,
                        CapFitScratch& scratch);

// Fits; returns false if the matrix is singular to working precision. `points` are padded.
bool fit_cap(const CapFrame& frame, const CapPoints& points, const CapFitOptions& options,
             CapFitScratch& scratch, CapFit& fit);

}  // namespace rholm
