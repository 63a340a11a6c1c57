// One function on the sphere, cut off at each of its degrees, at the same directions again and
// again. Layer: studio.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm::studio {

// f_d(u_j) - base_j for all degrees d and directions j in single precision: what is left of the
// function where it is near the base is exact to 1e-7 of itself, not of the function.
class DegreeTable {
 public:
  // Whether it is small enough, and soon enough made, to be worth it.
  static bool fits(std::size_t directions, int degree);

  // Directions are unit vectors; base has one value for each. About L^2 operations a direction.
  DegreeTable(const Coefficients& coefficients, std::span<const Vec3> directions,
              std::span<const double> base, const Context& context = {});

  int degree() const { return degree_; }
  std::size_t directions() const { return n_; }
  // Of degree d <= degree(), by directions.
  std::span<const float> cut_off_at(int d) const { return {&values_[d * n_], n_}; }
  // sum_l gains_l f_l, less `base` as it was given, which must be given again: gains of degrees
  // 0 ... at most degree(), those that follow are 0.
  std::vector<float> filtered(std::span<const double> gains, std::span<const double> base) const;

 private:
  int degree_;
  std::size_t n_;
  std::vector<float> values_;  // [degree + 1][n]
};

}  // namespace rholm::studio
