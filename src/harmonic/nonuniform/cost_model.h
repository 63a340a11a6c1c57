// What the inner loops take: nanoseconds of one core, by which windows, grids, rules and points are
// chosen. All constants of the kind stand in cost_model.cpp; bench/cost_model_bench measures each
// anew and prints it beside the one in use. Only their ratios matter.
#pragma once

#include <cstddef>

#include "harmonic/nonuniform/sphere_fourier.h"

namespace rholm {

// Spreading one source of 0, 1 or 2 derivatives, or interpolating one point.
double source_cost(int width, bool single, int derivatives);
// The same where the window is not known yet, and adding a cell of one grid to another.
double typical_source_cost();
double typical_cell_cost();
// Work that two threads are worth it for.
double second_thread_cost();

// One cell between so many grids and their transforms: cleared, added up, folded, gathered.
double cell_cost(bool single, std::size_t grids);
// The Fourier transform of a row of so many complex numbers, a length of small factors.
double row_cost(std::size_t points, bool single);
// Legendre sums between so many rings, both hemispheres, and the degrees up to L.
double legendre_cost(int degree, std::size_t rings);
// All between grids and coefficients.
double grid_cost(const SphereFourier& fourier, bool single, std::size_t grids);

// Sums term by term.
double direct_cost(std::size_t sources, int degree, int derivatives);

// What a face of a surface has more than sources at its corners (transform/mesh_pass): a node of
// its own, found and spread; one in common with others; second derivatives at the corners.
double own_node_cost();
double common_node_cost();
double hessians_cost();

// The error of an expansion at points of a surface (transform/error): a point, and the grid that
// all are interpolated on.
double error_point_cost();
double error_grid_cost(int degree);

}  // namespace rholm
