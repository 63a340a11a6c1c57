#include "harmonic/nonuniform/cost_model.h"

#include <cmath>

namespace rholm {
namespace {

// Of one core of an AMD EPYC (Zen 4) with AVX-512: smallest of many runs.

// Spreading: base + cell for each cell added to, for values, gradients and Hessians, by windows of
// up to 8 points and by wider ones, which add whole groups. Interpolation takes as long within a
// quarter.
struct SourceCost {
  double base, cell;
};
constexpr SourceCost kSingle[2][3] = {{{6.2, 0.125}, {6.9, 0.18}, {9.8, 0.23}},
                                      {{9.0, 0.09}, {11.4, 0.124}, {12.2, 0.193}}};
constexpr SourceCost kDouble[2][3] = {{{7.6, 0.145}, {9.3, 0.22}, {13.8, 0.29}},
                                      {{10.0, 0.098}, {14.4, 0.142}, {19.8, 0.212}}};
// The cell of one grid, and of each further one.
constexpr double kCellSingle = 1.0, kCellDouble = 1.8;
constexpr double kMoreSingle = 0.5, kMoreDouble = 0.8;
// n log2(n) times this, more for lengths with a factor 25 above 400.
constexpr double kRowSingle = 0.085, kRowDouble = 0.145, kSlowLength = 1.1;
// One ring pair and one (l, m); one order.
constexpr double kRingTerm = 0.15, kOrder = 600;
// One source and one (l, m), value only.
constexpr double kDirectTerm = 0.52;

}  // namespace

double source_cost(int width, bool single, int derivatives) {
  const bool wide = width > 8;
  const SourceCost& cost = (single ? kSingle : kDouble)[wide][derivatives];
  // A group of four more where the first tap is the last of one.
  const int columns = wide ? (width + 6) / 4 * 4 : width;
  return cost.base + cost.cell * width * columns;
}

double typical_source_cost() { return 15; }
double typical_cell_cost() { return 2; }
double second_thread_cost() { return 4e5; }  // chosen: 0.4 ms

double cell_cost(bool single, std::size_t grids) {
  return (single ? kCellSingle : kCellDouble) +
         static_cast<double>(grids - 1) * (single ? kMoreSingle : kMoreDouble);
}

double row_cost(std::size_t points, bool single) {
  const double n = static_cast<double>(points);
  const double slow = points > 400 && points % 25 == 0 ? kSlowLength : 1;
  return slow * (single ? kRowSingle : kRowDouble) * n * std::log2(n);
}

double legendre_cost(int degree, std::size_t rings) {
  const double orders = degree + 1.0;
  return 0.25 * orders * orders * static_cast<double>(rings) * kRingTerm + orders * kOrder;
}

double grid_cost(const SphereFourier& fourier, bool single, std::size_t grids) {
  const GridLayout& layout = fourier.layout;
  const double row = row_cost(layout.n_phi / 2, single);
  const double circles = row_cost(layout.n_theta, single) + row_cost(2 * fourier.n_rings, single);
  return static_cast<double>(layout.cells()) * cell_cost(single, grids) +
         static_cast<double>(layout.rows) * row + 0.5 * (fourier.degree + 1.0) * circles +
         legendre_cost(fourier.degree, fourier.n_rings);
}

double direct_cost(std::size_t sources, int degree, int derivatives) {
  const double l = degree + 1.0;
  // Gradients are three sums more, Hessians ten.
  const double sums = derivatives == 0 ? 1 : derivatives == 1 ? 4 : 14;
  return static_cast<double>(sources) * l * (l + 1) / 2 * kDirectTerm * sums;
}

double own_node_cost() { return 40; }
double common_node_cost() { return 35; }
double hessians_cost() { return 36; }

double error_point_cost() { return 30; }
double error_grid_cost(int degree) { return 24.0 * degree * degree; }

}  // namespace rholm
