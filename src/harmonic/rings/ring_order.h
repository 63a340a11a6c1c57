// The recurrence of ring_sums.h in l, for one order m.
//
// x = cos theta, s = sin theta, Pt_lm(x) as in legendre_kernels.h, and
//   x Pt_l = eps_{l+1} Pt_{l+1} + eps_l Pt_{l-1},   eps_l^2 = (l^2 - m^2) / (4 l^2 - 1).
// Ishioka (2018): let q_l = Pt_l / x for odd l - m. Both parities are sums over the same q,
//   Pt_k = eps_{k+1} q_{k+1} + eps_k q_{k-1}  for even k - m,      Pt_l = x q_l.
// Step j stands for the degrees k = m + 2j and l = k + 1. Let q_l = alpha_j lambda_j,
// g_j = eps_{l+1} eps_{l+2}, alpha_0 = 1 / eps_{m+1} and alpha_{j+1} alpha_j g_j = 1. Then
//   lambda_{j+1} = alpha_j^2 (x^2 - eps_l^2 - eps_{l+1}^2) lambda_j - lambda_{j-1},
//   lambda_{-1} = 0,   lambda_0 = Pt_mm.
// This is two multiplications for two degrees. It loses digits where its characteristic roots
// coincide, as sqrt(L) / sin(2 theta). Rings near the pole use differences relative to the solution
// at s = 0, lambda_{j+1} = rho_j lambda_j up to a factor s^m. Then
//   delta_{j+1}  = delta_j / rho_{j-1} - alpha_j^2 s^2 lambda_j,   delta_0 = 0
//   lambda_{j+1} = rho_j lambda_j + delta_{j+1},   rho_j = alpha_j^2 (k+m+2)(k+m+3)/((2k+3)(2k+5)).
// Near the equator q is large relative to Pt_k. Rings there use steps of single degrees:
// Pt_k = beta_j eps_{k+1} p_j and q_l = beta_j r_j, beta_{j+1} = beta_j eps_{k+2} / eps_{k+3}. Then
//   p_{j+1} = (x^2 r_j - eps_{k+1}^2 p_j) / eps_{k+2}^2,   p_0 = Pt_mm
//   r_{j+1} = p_{j+1} - r_j,                               r_0 = p_0.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/aligned_array.h"

namespace rholm {

// Tables from which the recurrences of all orders up to degree L are made. Threads may share them.
struct RingTables {
  explicit RingTables(int degree);

  int degree = 0;
  std::vector<double> mu;  // Pt_mm / s^m
  // Functions of n = 2i + parity at [parity][i]: sqrt(n), 1 / sqrt(4 n^2 - 1), 1 / ((2n-1)(2n+3)).
  std::array<AlignedArray<double>, 2> root, inverse_root, inverse_product;
};

// The factors of one order, with index j = 0 ... n_steps() - 1; arrays are padded.
struct RingOrder {
  int m = 0;
  int degree = 0;  // L >= m
  double mu = 0;
  std::size_t n_steps() const { return static_cast<std::size_t>(degree - m) / 2 + 1; }

  AlignedArray<double> eps_odd, eps_even;  // eps_{k+1}, eps_{k+2}
  AlignedArray<double> alpha;
  // The factor of lambda_j is a x^2 + b, which equals -a s^2 + c.
  AlignedArray<double> a, minus_a, b, c;
  double polar_below = 0;                 // sin theta below which rings use rho, or 0
  AlignedArray<double> rho, inverse_rho;  // rho_j, 1 / rho_{j-1}
  double single_below = 0;                // cos theta below which rings use of_r ... beta, or 0
  AlignedArray<double> of_r, of_p, beta;  // 1 / eps_{k+2}^2, (eps_{k+1} / eps_{k+2})^2, beta_j
};
// Fills `order` and reuses its memory.
void set_ring_order(const RingTables& tables, int m, RingOrder& order);

// Returns true if Pt_lm is negligible for all l <= degree at every colatitude with sin theta <= s.
bool stays_hidden(int m, int degree, double s);

}  // namespace rholm
