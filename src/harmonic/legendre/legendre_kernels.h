// The inner loops: sums with associated Legendre functions for one order m, by the recurrence of
// legendre_order.h.
#pragma once

#include <cstddef>
#include <vector>

#include "harmonic/legendre/legendre_order.h"

namespace rholm {

// Arrays over sources are padded to a multiple of this with x = 0, s = 1 and zero weights.
inline constexpr std::size_t kLegendreLanes = 32;

// c[l-m] += sum_j Pt_lm(x_j) re_j and s[l-m] += sum_j Pt_lm(x_j) im_j.
void legendre_adjoint(const LegendreOrder& order, const double* x, const double* s, std::size_t n,
                      const double* re, const double* im, double* c_out, double* s_out);

// For each of n_sets in {1, 4} pairs of rows c[set], s[set] (index l - m):
// re[set][j] = sum_l c[set][l-m] Pt_lm(x_j), im likewise. Overwrites.
void legendre_forward(const LegendreOrder& order, const double* x, const double* s, std::size_t n,
                      int n_sets, const double* const* c, const double* const* sn,
                      double* const* re, double* const* im);

// All Pt_lm(x) for one argument, l = m ... L: scalar, for tests and tables.
std::vector<double> legendre_row(const LegendreOrder& order, double x, double s);

}  // namespace rholm
