// Sums over rings for one order m: the Legendre stage of every fast transform.
//
// Rings lie symmetric about the equator: with F(theta) and F(pi - theta) in even and odd part, each
// ring of the northern half stands for two. The functions Pt_lm(cos theta) are those of
// legendre_kernels.h, the recurrences those of ring_order.h. Values below 5e-20 are left out.
#pragma once

#include "harmonic/rings/half_rings.h"
#include "harmonic/rings/ring_order.h"

namespace rholm {

// With even = F(theta) + F(pi - theta) and odd = F(theta) - F(pi - theta) per ring (at the equator
// even = F, odd = 0), adds to c[l-m] and s[l-m], l = m ... L, the sum over rings of Pt_lm(theta)
// times the even or odd part, as l - m is. Arrays over rings have rings.padded entries, zeros
// beyond rings.size.
void ring_adjoint(const RingOrder& order, const HalfRings& rings, const double* even_re,
                  const double* even_im, const double* odd_re, const double* odd_im, double* c,
                  double* s);

// even_re = sum over even l - m of c[l-m] Pt_lm(theta), odd_re over odd l - m; even_im, odd_im with
// s. So F(theta) = even + odd and F(pi - theta) = even - odd. Overwrites rings.padded entries.
void ring_forward(const RingOrder& order, const HalfRings& rings, const double* c, const double* s,
                  double* even_re, double* even_im, double* odd_re, double* odd_im);

}  // namespace rholm
