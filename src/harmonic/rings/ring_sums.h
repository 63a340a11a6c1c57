// Sums over rings for one order m: the Legendre stage of every fast transform.
//
// Rings lie symmetric about the equator: with F(theta) and F(pi - theta) in even and odd part, each
// ring of the northern half stands for two. The functions Pt_lm(cos theta) are those of
// legendre_kernels.h, the recurrences those of ring_order.h. Values below 5e-20 are left out.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/aligned_array.h"
#include "harmonic/rings/ring_order.h"

namespace rholm {

// Arrays over rings are padded to a multiple of this.
inline constexpr std::size_t kRingBlock = 32;
inline constexpr std::size_t kRingGroup = 8;  // divides it

// The northern half of symmetric rings: 0 <= theta <= pi/2. An equator ring is its own mirror
// image.
struct HalfRings {
  // Best ascending or descending: sums are fast where the rings of a block are near each other.
  explicit HalfRings(std::span<const double> north_colatitudes);

  std::size_t size = 0;    // rings of the northern half
  std::size_t padded = 0;  // array lengths; what is beyond `size` repeats the last ring
  AlignedArray<double> cos_theta, sin_theta, cos2, sin2;
  // log2(sin theta) = log2_sin + log2_sin_rest; the first has so few bits that its product with
  // any order is exact. At a pole a number that stands for minus infinity.
  AlignedArray<double> log2_sin, log2_sin_rest;
  AlignedArray<double> largest_sin;           // of every kRingGroup rings
  AlignedArray<double> least_sin, least_cos;  // of every kRingBlock rings
};

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
