// Between scattered sources and a grid of colatitude and longitude: the inner loops.
//
// The grid covers longitudes once and colatitudes from a little before the north pole to a little
// past the south pole: on the great circle through both, a direction past a pole is (theta ->
// -theta, phi -> phi + pi). Point (row, column) stands for
//   theta = (row - w/2) 2 pi / n_theta,  phi = (column - w/2) 2 pi / n_phi,
// so that all taps of a source have indices >= 0; columns from n_phi on belong to the next turn.
#pragma once

#include <cstddef>
#include <cstdint>

#include "harmonic/nonuniform/window.h"

namespace rholm {

struct GridLayout {
  int width = 0;            // w
  std::size_t n_phi = 0;    // points a turn, a multiple of 4
  std::size_t n_theta = 0;  // points of the great circle, a multiple of 4
  std::size_t rows = 0;     // n_theta / 2 + w
  std::size_t stride = 0;   // from row to row, at least n_phi + padded width + 1

  std::size_t cells() const { return rows * stride; }
};
GridLayout grid_layout(int width, std::size_t n_phi, std::size_t n_theta);

// Both windows and their polynomials.
template <typename T>
struct GridKernel {
  GridLayout layout;
  SpreadTable<T> theta, phi;
};

// Up to kSize sources, structure of arrays: positions x (any length but 0; in double precision for
// grids in single as well), and the factors of
// f(x/|x|), of its gradient and of its Hessian (six numbers: xx, xy, xz, yy, yz, zz; an
// off-diagonal one counts twice in the contraction) with respect to x.
template <typename T>
struct SourceBatch {
  static constexpr std::size_t kSize = 256;
  alignas(64) double x[3][kSize];
  alignas(64) T value[kSize];
  alignas(64) T gradient[3][kSize];
  alignas(64) T hessian[6][kSize];
};

// Sources with derivatives so near to a pole that longitudes there lose digits: left out, their
// indices returned. No more than a few of many sources; see NonuniformPlan.
struct PolarSources {
  std::size_t count = 0;
  std::uint32_t index[SourceBatch<double>::kSize];
};

// Adds the first n sources to the grid; derivatives 0, 1 or 2 says how much of them is used. Sums
// are in double precision whatever the windows are in: in single, those of many terms of one sign
// lose the small ones, and boxes of a million faces were off by 5e-6. `polar_sine`: sources with
// derivatives and sin theta below it are left out and listed.
template <typename T>
void spread(const GridKernel<T>& kernel, const SourceBatch<T>& batch, std::size_t n,
            int derivatives, double polar_sine, double* grid, PolarSources& polar);

// The transpose: value[j] = the grid's function at x_j; with `derivatives` 1 also gradient[.][j],
// by x. Writes into the batch; polar sources get the value alone.
template <typename T>
void interpolate(const GridKernel<T>& kernel, const T* grid, std::size_t n, int derivatives,
                 double polar_sine, SourceBatch<T>& batch, PolarSources& polar);

}  // namespace rholm
