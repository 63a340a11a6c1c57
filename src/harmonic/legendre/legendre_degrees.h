// Sums of one order kept apart by degree, which give the function for every truncation degree.
#pragma once

#include <cstddef>

#include "harmonic/legendre/legendre_order.h"

namespace rholm {

// Adds (c[l-m] cosine[j] + s[l-m] sine[j]) Pt_lm(x_j) to sums[(l - m) n + j], l = m ... L.
// Arrays hold n directions, a multiple of kLegendreLanes: `x` is cos theta, `cosine` cos m phi and
// `sine` sin m phi.
void add_by_degree(const LegendreOrder& order, const double* x, const double* sin_theta,
                   const double* cosine, const double* sine, std::size_t n, const double* c,
                   const double* s, double* sums);

}  // namespace rholm
