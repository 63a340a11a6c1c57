// Transforms of functions given on a grid of colatitudes and longitudes. Layer: harmonic.
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

// Where the rings of a grid are, i = 0 ... n_theta - 1.
enum class GridKind {
  kGaussLegendre,        // theta_i = arccos of the Gauss-Legendre nodes
  kEquiangular,          // theta_i = (i + 1/2) pi / n_theta
  kEquiangularWithPoles  // theta_i = i pi / (n_theta - 1): the first and last ring are poles
};

// A grid of n_theta n_phi directions.
struct Grid {
  GridKind kind = GridKind::kGaussLegendre;  // where its rings are
  int n_theta = 0;                           // how many rings
  int n_phi = 0;                             // directions on each
};

// The highest degree to which functions on this grid are analyzed exactly: n_theta - 1, with poles
// n_theta - 2, and (n_phi - 1) / 2, whichever is less. May be negative.
int exact_degree(const Grid& grid);

// The smallest grid with exact_degree() >= degree, n_phi a number that is fast to transform.
// Throws InvalidInput for a degree out of range.
Grid smallest_grid(GridKind kind, int degree);

// theta_i, n_theta of them. Throws InvalidInput for a grid without rings (with poles: without two)
// or more than 4 (kMaxDegree + 1).
std::vector<double> grid_colatitudes(const Grid& grid);

// f(theta_i, phi_k). Throws InvalidInput for n_phi < 2 L + 1, Cancelled.
std::vector<double> synthesize_grid(const Coefficients& coefficients, const Grid& grid,
                                    const Context& context = {});

// Coefficients up to `degree` <= exact_degree(grid) =: D of the function with these values: exact
// to rounding if it has degree D or less, whatever `degree`. Otherwise what lies above D comes back
// as an error below it (aliasing). values.size() == n_theta n_phi. Throws InvalidInput for other
// sizes or degrees, or a value that is not finite; Cancelled.
Coefficients analyze_grid(std::span<const double> values, const Grid& grid, int degree,
                          const Context& context = {});

}  // namespace rholm
