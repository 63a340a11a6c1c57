// Inner loops of the fits of patches. Layer: edit.
#pragma once

#include <cstddef>

#include "atlas/cap/cap_limits.h"
#include "harmonic/legendre/low_harmonics.h"
#include "rholm/atlas.h"

namespace rholm {

// Points are worked on in whole vectors: arrays of them are padded to a multiple of kCapLanes. And
// this many at a time: the rows of degree 8 at them, 104 KiB, stay in a second-level cache.
inline constexpr std::size_t kPatchBlock = 256;

// The harmonics of a patch: all up to degree 3, beyond those with l + m even. The even ones are
// complete on a hemisphere, but slow where a function does not meet the equator at a right angle,
// and a plane does not: a few odd ones take that part. (scripts/constants; on a paraboloid the
// error of degree 8 falls from 6e-3 to 2e-5 wavelengths.) Ordered by degree.
inline constexpr int kPatchOdd = 3;
constexpr std::size_t patch_basis(int degree) {
  const auto d = static_cast<std::size_t>(degree + 1);
  constexpr auto kOdd = static_cast<std::size_t>(kPatchOdd + 1);
  return d <= kOdd ? d * d : d * (d + 1) / 2 + kOdd * (kOdd - 1) / 2;
}

// The place of the cosine of (l, m) among them; its sine is the next.
constexpr std::size_t patch_index(int l, int m) {
  return l <= kPatchOdd ? low_index(l, m)
                        : even_index(l, m) + patch_basis(kPatchOdd) - even_index(kPatchOdd + 1, 0);
}
constexpr bool in_patch_basis(int l, int m) { return l <= kPatchOdd || ((l + m) & 1) == 0; }

// Calls visit(l, m, index) for each.
template <class Visit>
void for_each_patch_harmonic(int degree, const Visit& visit) {
  for (int l = 0; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      if (in_patch_basis(l, m)) visit(l, m, patch_index(l, m));
    }
  }
}

// At n points (a multiple of kCapLanes), given by their offsets from the cap's seed, offsets[axis
// * n + i]: rows[i] is phi = |x - c| / R_0 - 1, rows[(1 + k) * n + i] the k-th harmonic, area[i]
// the area on the opened sphere per area across the ray, in units of R_0^2. Points at the centre or
// behind it give numbers without meaning, never NaN.
void patch_rows(const CapFrame& frame, int degree, const double* offsets, std::size_t n,
                double* rows, double* area);

// out_i = sum_k coefficients_k row_k(i).
void patch_sum(const double* rows, const double* coefficients, std::size_t count, std::size_t n,
               double* out);

// The same of degree + 1 sets of coefficients, those of degree d at [d patch_basis(degree)] and 0
// beyond patch_basis(d): out[d * stride + i].
void patch_sums(const double* rows, const double* coefficients, int degree, std::size_t n,
                double* out, std::size_t stride);

// Weights of the points nearer than `radius` to (x, y, z) become 0; offsets as above.
void zero_weights_within(const double* offsets, std::size_t n, const double* at, double radius,
                         double* weights);

}  // namespace rholm
