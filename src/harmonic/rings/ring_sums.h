// Sums over rings for one order m: the Legendre stage of every fast transform.
//
// Rings are symmetric about the equator: with the even and odd parts of F(theta) and F(pi - theta),
// each northern ring stands for two. The functions Pt_lm(cos theta) are as in legendre_kernels.h,
// the recurrences as in ring_order.h. Values below 5e-20 are left out.
#pragma once

#include "harmonic/rings/half_rings.h"
#include "harmonic/rings/ring_order.h"

namespace rholm {

// Adds to c[l-m] and s[l-m], l = m ... L, the sum over rings of Pt_lm(theta) times a part of F. The
// part is even = F(theta) + F(pi - theta) for even l - m, odd = F(theta) - F(pi - theta) for odd l
// - m (at the equator even = F, odd = 0). Arrays over rings have rings.padded entries, which are
// zeros beyond rings.size.
void ring_adjoint(const RingOrder& order, const HalfRings& rings, const double* even_re,
                  const double* even_im, const double* odd_re, const double* odd_im, double* c,
                  double* s);

// Sets even_re, odd_re to the sums over even, odd l - m of c[l-m] Pt_lm(theta), even_im, odd_im
// with s: F(theta) = even + odd, F(pi - theta) = even - odd. Overwrites rings.padded entries.
void ring_forward(const RingOrder& order, const HalfRings& rings, const double* c, const double* s,
                  double* even_re, double* even_im, double* odd_re, double* odd_im);

}  // namespace rholm
