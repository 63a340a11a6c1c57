// The recurrence of the associated Legendre functions for one order m.
//
// Pt_lm(x) = N_m Pbar_lm(x) is normalised so that Pt_lm(cos theta) cos(m phi) is the real
// orthonormal harmonic without Condon-Shortley phase. With Q_l = Pt_lm / nu_l scaled to a common
// value at x = 1, the three-term recurrence reads
//   (l+m+1) (Q_{l+1} - Q_l) = (l-m) (Q_l - Q_{l-1}) + (2l+1) (x-1) Q_l.
// This form in differences (Reinsch's, for m = 0) keeps full accuracy next to the poles. The usual
// form loses l^2 rounding units there, because its characteristic roots coincide. Let
// d_l = nu_l (Q_l - Q_{l-1}) and rho_l = nu_{l+1} / nu_l. Then
//   d_{l+1}  = rho_l [(l-m) d_l + (2l+1) (x-1) Pt_l] / (l+m+1),   d_m = 0.
//   Pt_{l+1} = rho_l Pt_l + d_{l+1},                              Pt_mm = mu_m s^m.
// It runs with |x|, where x - 1 = -s^2/(1+|x|), and Pt_lm(-x) = (-1)^{l-m} Pt_lm(x). s^m underflows
// near the poles. Each value is therefore stored as p 2^(960 k) with k <= 0 (Fukushima 2012), which
// is accurate at any colatitude.
#pragma once

#include <vector>

namespace rholm {

// The coefficients of the recurrence of one order up to degree L.
struct LegendreOrder {
  int m = 0;
  int degree = 0;  // L >= m
  double mu = 0;   // Pt_mm / s^m
  // Factors of Pt_l and, in d_{l+1}, of d_l and (x-1) Pt_l, with index l - m for m <= l < L.
  std::vector<double> rho, of_difference, of_value;
};
LegendreOrder legendre_order(int m, int degree, double mu);

// Returns mu_m for m = 0 ... L: sqrt((2 - [m = 0]) (2m+1)!! / ((2m)!! 4 pi)).
std::vector<double> legendre_mu(int degree);

}  // namespace rholm
