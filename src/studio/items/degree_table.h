// A function on the sphere, cut off at each of its
// degrees, at fixed directions. Layer: studio.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm::studio {

// Stores f_d(u_j) - base_j for all degrees d and directions j in single precision. Near
// the base, the error is therefore 1e-7 of the small difference, not of the function.
class DegreeTable {
 public:
  // Returns true if the table is small and quick enough to be useful.
  static bool fits(std::size_t directions, int degree);

  // Takes unit directions with one base value each. About L^2 operations per direction.
  DegreeTable(const Coefficients& coefficients, std::span<const Vec3> directions,
              std::span<const double> base, const Context& context = {});

  int degree() const { return degree_; }
  std::size_t directions() const { return n_; }
  // Returns the values for degree d <= degree(), by direction.
  std::span<const float> cut_off_at(int d) const { return {&values_[d * n_], n_}; }
  // Returns sum_l gains_l f_l - base. `base` must be the one given to the
  // constructor. `gains` are for degrees 0 ... at most degree(); missing gains are 0.
  std::vector<float> filtered(std::span<const double> gains, std::span<const double> base) const;

 private:
  int degree_;
  std::size_t n_;
  std::vector<float> values_;  // [degree + 1][n]
};

}  // namespace rholm::studio
