// Costs of the inner loops in nanoseconds of one core, which choose windows, grids, rules and
// points. All such constants are in cost_model.cpp. The program bench/cost_model_bench measures
// each again and prints it beside the one in use. Only the ratios matter.
#pragma once

#include <cstddef>

#include "harmonic/nonuniform/sphere_fourier.h"

namespace rholm {

// Cost of spreading a source with 0, 1 or 2 derivatives, or of interpolating a point.
double source_cost(int width, bool single, int derivatives);
// The cost while the window is unknown, and the cost of adding a cell of one grid to another.
double typical_source_cost();
double typical_cell_cost();
// Amount of work from which a second thread is worthwhile.
double second_thread_cost();

// Cost of a cell of `grids` grids before their transform: cleared, summed, folded and gathered.
double cell_cost(bool single, std::size_t grids);
// Cost of the Fourier transform of `points` complex numbers, a length of small prime factors.
double row_cost(std::size_t points, bool single);
// Cost of Legendre sums on `rings` rings of both hemispheres, for degrees up to L.
double legendre_cost(int degree, std::size_t rings);
// Cost of all steps between grids and coefficients.
double grid_cost(const SphereFourier& fourier, bool single, std::size_t grids);

// Cost of direct sums, term by term.
double direct_cost(std::size_t sources, int degree, int derivatives);

// Further costs of a face of a surface beside its corners (transform/mesh_pass). They are for a
// quadrature node of its own, a node shared with other faces, and second derivatives at corners.
double own_node_cost();
double common_node_cost();
double hessians_cost();

// Costs of the error of an expansion at points of a surface (transform/error). They are for a
// point, and for the grid from which all points are interpolated.
double error_point_cost();
double error_grid_cost(int degree);

}  // namespace rholm
