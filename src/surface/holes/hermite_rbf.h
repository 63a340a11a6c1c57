// Smooth function with given zeros and given gradients at them. Layer: surface.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rholm/vec3.h"

namespace rholm {

// s(x) = sum_j [alpha_j phi(x - x_j) - beta_j . grad phi(x - x_j)] + a + b . x
// with phi(d) = |d|^3. Among all functions with s(x_i) = 0 and grad s(x_i) = n_i
// this one bends least (by its natural semi-norm; Macedo, Gois, Velho 2011).
class HermiteRbf {
 public:
  // Takes at most kMaxCenters distinct centres with unit
  // normals. Solves a dense system of 4 n + 4 equations.
  static constexpr std::size_t kMaxCenters = 400;
  HermiteRbf(std::span<const Vec3> centers, std::span<const Vec3> normals);

  // Returns false if the system has no useful solution, e.g. for nearly coincident centres.
  bool valid() const { return valid_; }
  double operator()(const Vec3& x) const { return at(x).value; }
  struct Value {
    double value = 0;
    Vec3 gradient;
  };
  Value at(const Vec3& x) const;

 private:
  struct Term {
    Vec3 center;  // position in the centres' frame: mean at 0, extent 1
    double alpha = 0;
    Vec3 beta;
  };
  std::vector<Term> terms_;
  double constant_ = 0;
  Vec3 linear_;
  Vec3 middle_;
  double scale_ = 1;
  bool valid_ = false;
};

}  // namespace rholm
