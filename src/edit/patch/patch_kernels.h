// Inner loops of the fits of patches. Layer: edit.
#pragma once

#include <cstddef>

#include "atlas/cap/cap_limits.h"
#include "harmonic/legendre/low_harmonics.h"
#include "rholm/atlas.h"

namespace rholm {

// Number of points per block: the rows of degree 8, 104 KiB, stay in a
// second-level cache. Arrays of points are padded to a multiple of kCapLanes.
inline constexpr std::size_t kPatchBlock = 256;

// Harmonics of a patch, ordered by degree: all up to degree 3, beyond it only even l + m. Even
// ones are complete on a hemisphere, but converge slowly if the function does not meet the
// equator at a right angle, like a plane. Some odd ones represent that part. (scripts/constants;
// on a paraboloid the error of degree 8 falls from 6e-3 to 2e-5 wavelengths.)
inline constexpr int kPatchOdd = 3;
constexpr std::size_t patch_basis(int degree) {
  const auto d = static_cast<std::size_t>(degree + 1);
  constexpr auto kOdd = static_cast<std::size_t>(kPatchOdd + 1);
  return d <= kOdd ? d * d : d * (d + 1) / 2 + kOdd * (kOdd - 1) / 2;
}

// Returns the index of the cosine of (l, m) in the basis; its sine is the next.
constexpr std::size_t patch_index(int l, int m) {
  return l <= kPatchOdd ? low_index(l, m)
                        : even_index(l, m) + patch_basis(kPatchOdd) - even_index(kPatchOdd + 1, 0);
}
constexpr bool in_patch_basis(int l, int m) { return l <= kPatchOdd || ((l + m) & 1) == 0; }

// Calls visit(l, m, index) for each harmonic of the basis.
template <class Visit>
void for_each_patch_harmonic(int degree, const Visit& visit) {
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      if (in_patch_basis(l, m)) visit(l, m, patch_index(l, m));
    }
  }
}

// Takes n points (a multiple of kCapLanes), by offsets[axis * n + i] from the cap's seed.
// Sets rows[i] to phi = |x - c| / R_0 - 1, rows[(1 + k) * n + i] to the k-th harmonic.
// Sets area[i] to the area on the opened sphere per area across the ray, in units of
// R_0^2. Points at the centre or behind it give numbers without meaning, but never NaN.
void patch_rows(const CapFrame& frame, int degree, const double* offsets, std::size_t n,
                double* rows, double* area);

// Computes out_i = sum_k coefficients_k row_k(i).
void patch_sum(const double* rows, const double* coefficients, std::size_t count, std::size_t n,
               double* out);

// Does so for degree + 1 sets of coefficients into out[d * stride + i]. The set
// of degree d is at [d patch_basis(degree)], and zero beyond patch_basis(d).
void patch_sums(const double* rows, const double* coefficients, int degree, std::size_t n,
                double* out, std::size_t stride);

// Sets the weights of points within `radius` of `at` to 0; offsets as above.
void zero_weights_within(const double* offsets, std::size_t n, const double* at, double radius,
                         double* weights);

}  // namespace rholm
