// The sums of one order kept apart by degree: what a function is when it is cut off anywhere.
#pragma once

#include <cstddef>

#include "harmonic/legendre/legendre_order.h"

namespace rholm {

// Adds the terms of the order to the sums of the degrees:
// sums[(l - m) n + j] += (c[l-m] cosine[j] + s[l-m] sine[j]) Pt_lm(x_j), l = m ... L.
// n directions, a multiple of kLegendreLanes: cos theta, sin theta, cos m phi, sin m phi.
void add_by_degree(const LegendreOrder& order, const double* x, const double* sin_theta,
                   const double* cosine, const double* sine, std::size_t n, const double* c,
                   const double* s, double* sums);

}  // namespace rholm
