// Inner loops between scattered sources and a grid of colatitude and longitude.
//
// The grid covers longitudes once, and colatitudes from slightly before the north pole to slightly
// past the south pole. On the great circle through both, a direction past a pole is (theta ->
// -theta, phi -> phi + pi). The point (row, column) is at
//   theta = (row - w/2) 2 pi / n_theta,  phi = (column - w/2) 2 pi / n_phi.
// All taps of a source thus have indices >= 0; columns from n_phi on belong to the next turn.
#pragma once

#include <cstddef>
#include <cstdint>

#include "harmonic/nonuniform/window.h"

namespace rholm {

struct GridLayout {
  int width = 0;            // w
  std::size_t n_phi = 0;    // points per turn, a multiple of 4
  std::size_t n_theta = 0;  // points of the great circle, a multiple of 4
  std::size_t rows = 0;     // n_theta / 2 + w
  std::size_t stride = 0;   // between rows, at least n_phi + padded width + 1

  std::size_t cells() const { return rows * stride; }
};
GridLayout grid_layout(int width, std::size_t n_phi, std::size_t n_theta);

// Both windows with their polynomials.
template <typename T>
struct GridKernel {
  GridLayout layout;
  SpreadTable<T> theta, phi;
};

// Up to kSize sources as a structure of arrays. Positions x have any length except 0 and are in
// double precision for every T. The other arrays are factors of f(x/|x|), of its gradient and of
// its Hessian with respect to x. The Hessian has six numbers, xx, xy, xz, yy, yz and zz; the
// off-diagonal ones count twice.
template <typename T>
struct SourceBatch {
  static constexpr std::size_t kSize = 256;
  alignas(64) double x[3][kSize];
  alignas(64) T value[kSize];
  alignas(64) T gradient[3][kSize];
  alignas(64) T hessian[6][kSize];
};

// Indices of sources with derivatives that are left out, because longitudes lose digits so near to
// a pole. Usually a small fraction of the sources; see NonuniformPlan.
struct PolarSources {
  std::size_t count = 0;
  std::uint32_t index[SourceBatch<double>::kSize];
};

// Adds the first n sources with 0, 1 or 2 derivatives. Sums are in double precision for every T. In
// single precision, sums of many terms of one sign lose small terms: boxes of a million faces were
// wrong by 5e-6. Sources with derivatives and sin theta below `polar_sine` are left out and listed
// in `polar`.
template <typename T>
void spread(const GridKernel<T>& kernel, const SourceBatch<T>& batch, std::size_t n,
            int derivatives, double polar_sine, double* grid, PolarSources& polar);

// Does the transpose: sets value[j] to the grid's function at x_j and, if `derivatives` is 1,
// gradient[.][j] to its gradient by x. Sources in `polar` get the value alone.
template <typename T>
void interpolate(const GridKernel<T>& kernel, const T* grid, std::size_t n, int derivatives,
                 double polar_sine, SourceBatch<T>& batch, PolarSources& polar);

}  // namespace rholm
