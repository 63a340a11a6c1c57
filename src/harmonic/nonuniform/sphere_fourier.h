// Transforms between the grid of scattered sources (spread.h) and coefficients: Fourier transforms
// along both angles, then Legendre sums on rings.
//
// On the great circle through the poles, a harmonic of order m is a trigonometric polynomial of
// degree l, with the parity of m in theta. Its values on n > L rings theta_q = (q + 1/2) pi / n
// determine it. Their Fourier transform gives its coefficients. Division by the windows'
// transforms and another transform give the grid. Coefficients come from the grid by the
// transposes.
#pragma once

#include <complex>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "harmonic/nonuniform/spread.h"
#include "rholm/coefficients.h"
#include "rholm/context.h"

namespace rholm {

struct SphereFourier {
  int degree = 0;
  GridLayout layout;
  SpreadWindow theta, phi;
  std::size_t n_rings = 0;  // n: above the degree, even, 2 n fast to transform, at least 32
};
SphereFourier sphere_fourier(int degree, const GridLayout& layout);

template <typename T>
GridKernel<T> grid_kernel(const SphereFourier& fourier);

// Applies the transpose of coefficients_to_grid() to the sum of the grids, and adds the result to
// `sum`. Destroys the grids.
void grid_to_coefficients(const SphereFourier& fourier, std::span<double* const> grids,
                          Coefficients& sum, const Context& context, const ParallelStage& stage);

// Fills the whole grid: all rows and columns that taps can reach.
template <typename T>
void coefficients_to_grid(const SphereFourier& fourier, const Coefficients& coefficients, T* grid,
                          const Context& context, const ParallelStage& stage);

}  // namespace rholm
