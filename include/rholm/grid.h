// Transforms of functions on a grid of colatitudes and longitudes. Layer: harmonic.
//
// Values are row-major [ring][longitude], rings from north to south, longitudes
// phi_k = 2 pi k / n_phi. Results are the same bits for every number of threads. Time is
// O(n_theta L^2).
#pragma once

#include <span>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"

namespace rholm {

// Colatitudes of the rings of a grid, i = 0 ... n_theta - 1.
enum class GridKind {
  kGaussLegendre,        // theta_i = arccos of the Gauss-Legendre nodes
  kEquiangular,          // theta_i = (i + 1/2) pi / n_theta
  kEquiangularWithPoles  // theta_i = i pi / (n_theta - 1): the first and last ring are poles
};

// A grid of n_theta n_phi directions.
struct Grid {
  GridKind kind = GridKind::kGaussLegendre;  // places of its rings
  int n_theta = 0;                           // number of rings
  int n_phi = 0;                             // number of directions on each ring
};

// Returns the highest degree at which functions on this grid are analyzed exactly: the minimum of
// n_theta - 1 (with poles n_theta - 2) and (n_phi - 1) / 2. May be negative.
int exact_degree(const Grid& grid);

// Returns the smallest grid with exact_degree() >= degree and n_phi fast for Fourier transforms.
// Throws InvalidInput for a degree out of range.
Grid smallest_grid(GridKind kind, int degree);

// Returns the n_theta values theta_i. Throws InvalidInput for a grid without rings (with poles:
// fewer than two) or with more than 4 (kMaxDegree + 1).
std::vector<double> grid_colatitudes(const Grid& grid);

// Returns f(theta_i, phi_k). Throws InvalidInput for n_phi < 2 L + 1, Cancelled.
std::vector<double> synthesize_grid(const Coefficients& coefficients, const Grid& grid,
                                    const Context& context = {});

// Returns the coefficients up to `degree` <= exact_degree(grid) =: D of the function with these
// values. They are exact to rounding if the function has degree D or less. Otherwise higher degrees
// alias: they appear as errors in lower ones. Throws InvalidInput for other degrees, values.size()
// != n_theta n_phi, or a value that is not finite; Cancelled.
Coefficients analyze_grid(std::span<const double> values, const Grid& grid, int degree,
                          const Context& context = {});

}  // namespace rholm
