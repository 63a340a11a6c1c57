#include "harmonic/nonuniform/cost_model.h"

#include <cmath>

namespace rholm {
namespace {

// Costs are in nanoseconds on one core at 2.5 GHz with AVX-512: the smallest of many runs.

// Cost of spreading a source: base + row * width, for values, gradients and Hessians. The
// lines are for rows of up to 8 and of up to 16 taps. Interpolation costs the same within a
// quarter.
struct SourceCost {
  double base, row;
};
constexpr SourceCost kSingle[2][3] = {{{3.7, 1.25}, {4.7, 1.8}, {5.6, 2.65}},
                                      {{4.7, 1.7}, {3.5, 2.7}, {4.8, 4.0}}};
constexpr SourceCost kDouble[2][3] = {{{6.6, 2.15}, {8.9, 3.0}, {13.0, 4.2}},
                                      {{7.2, 3.3}, {8.0, 4.8}, {12.0, 6.7}}};
// Cost of a cell of the first grid, and of each further grid.
constexpr double kCellSingle = 2.4, kCellDouble = 4.5;
constexpr double kMoreSingle = 1.6, kMoreDouble = 3.2;
// A row of n numbers costs this times n log2(n), more for lengths with a factor 25 above 400.
constexpr double kRowSingle = 0.17, kRowDouble = 0.30, kSlowLength = 1.5;
// Cost of one ring pair and one (l, m), and of one order.
constexpr double kRingTerm = 0.19, kOrder = 1500;
// Cost of one source and one (l, m), value only.
constexpr double kDirectTerm = 0.35;

}  // namespace

double source_cost(int width, bool single, int derivatives) {
  const SourceCost& cost = (single ? kSingle : kDouble)[width > 8][derivatives];
  return cost.base + cost.row * width;
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
  // Gradients need three more sums, Hessians ten more than gradients.
  const double sums = derivatives == 0 ? 1 : derivatives == 1 ? 4 : 14;
  return static_cast<double>(sources) * l * (l + 1) / 2 * kDirectTerm * sums;
}

double own_node_cost() { return 40; }
double common_node_cost() { return 35; }
double hessians_cost() { return 36; }

double error_point_cost() { return 60; }
double error_grid_cost(int degree) { return 45.0 * degree * degree; }

}  // namespace rholm
