// The inner loops: sums with associated Legendre functions for one order m, by the recurrence of
// legendre_order.h.
#pragma once

#include <cstddef>
#include <vector>

#include "harmonic/legendre/legendre_order.h"

namespace rholm {

// Arrays over sources are padded to a multiple of this number with x = 0, s = 1 and zero weights.
inline constexpr std::size_t kLegendreLanes = 32;

// Adds to c[l-m] the sum over j of Pt_lm(x_j) re_j, and to s[l-m] the sum of Pt_lm(x_j) im_j.
void legendre_adjoint(const LegendreOrder& order, const double* x, const double* s, std::size_t n,
                      const double* re, const double* im, double* c_out, double* s_out);

// Takes n_sets in {1, 4} pairs of rows c[set], sn[set] with index l - m. Overwrites re[set][j] with
// sum_l c[set][l-m] Pt_lm(x_j), and im[set][j] with the same sum of sn[set].
void legendre_forward(const LegendreOrder& order, const double* x, const double* s, std::size_t n,
                      int n_sets, const double* const* c, const double* const* sn,
                      double* const* re, double* const* im);

// Returns all Pt_lm(x), l = m ... L, for one argument. Scalar; used by tests and tables.
std::vector<double> legendre_row(const LegendreOrder& order, double x, double s);

}  // namespace rholm
