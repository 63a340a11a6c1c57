// K_0 and K_1 in closed form, the others by the three-term recurrence (M3):
//   (rho/2) (K_{m-1} + K_{m+1}) + C K_m = E_m,   E_0 = psi,   E_m = (1 - e^{-i m psi}) / (i m).
// Its homogeneous solutions grow like lambda^m, where lambda is the larger root of rho/2 x^2 + C
// x + rho/2. It runs forward while L ln|lambda| is small, and is otherwise solved as a diagonally
// dominant tridiagonal system.
#include "paper/methods/curl_integrals.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace rholm {
namespace {

using Complex = std::complex<double>;

// Returns atan(sqrt z)/sqrt z for z >= 0, artanh(sqrt -z)/sqrt -z for z < 0; `one_plus_z` is 1 + z.
double arc_tangent_ratio(double z, double one_plus_z) {
  if (std::abs(z) < 0.02) {  // nine terms: remainder 0.02^9/19 = 3e-17
    double sum = 0;
    for (int k = 8; k >= 0; --k) sum = 1.0 / (2 * k + 1) - z * sum;
    return sum;
  }
  const double root = std::sqrt(std::abs(z));
  if (z > 0) return std::atan(root) / root;
  // artanh y = ln((1+y)^2 / (1-y^2)) / 2, where 1 - y^2 = 1 + z is given.
  return 0.5 * std::log((1 + root) * (1 + root) / one_plus_z) / root;
}

Complex right_side(int m, double psi) {
  if (m == 0) return psi;
  const double x = m * psi;
  // (1 - e^{-ix}) / (i m) = (sin x - 2 i sin^2(x/2)) / m
  const double half = std::sin(x / 2);
  return Complex(std::sin(x), -2 * half * half) / static_cast<double>(m);
}

void run_forward(double C, double rho, double psi, double end_value, double k0,
                 std::span<Complex> out) {
  out[0] = k0;
  if (out.size() == 1) return;
  out[1] = Complex((psi - C * k0) / rho, std::log(end_value / (C + rho)) / rho);
  for (std::size_t m = 1; m + 1 < out.size(); ++m) {
    out[m + 1] = (right_side(static_cast<int>(m), psi) - C * out[m]) * (2 / rho) - out[m - 1];
  }
}

// Solves for K_1 ... K_{M-1} from K_0 and the leading asymptotics at M (Thomas algorithm).
void solve_tridiagonal(double C, double rho, double psi, double end_value, double k0,
                       double log_lambda, std::span<Complex> out) {
  const int last = static_cast<int>(out.size()) - 1;
  const int M = std::max(last, 1) + static_cast<int>(std::ceil(40 / log_lambda)) + 1;
  const Complex end_phase = std::polar(1.0, -M * psi);
  const Complex k_end = (1 / (C + rho) - end_phase / end_value) / Complex(0, M);
  std::vector<double> upper(M, 0.0);
  std::vector<Complex> value(M, 0.0);
  const double off = rho / 2;
  for (int m = 1; m < M; ++m) {
    Complex right = right_side(m, psi);
    if (m == 1) right -= off * k0;
    if (m == M - 1) right -= off * k_end;
    const double pivot = C - off * upper[m - 1];
    upper[m] = off / pivot;
    value[m] = (right - off * value[m - 1]) / pivot;
  }
  Complex next = 0;
  for (int m = M - 1; m >= 1; --m) {
    next = value[m] - upper[m] * next;
    if (m <= last) out[m] = next;
  }
  out[0] = k0;
}

}  // namespace

// With eps = (C-rho)/(C+rho) and T = tan(psi/2): K_0 = 2 T f(eps T^2) / (C+rho) and
// 1 + eps T^2 = D(psi) (1 + T^2) / (C+rho). If C > rho, each turn of psi adds
// 2 pi / sqrt(C^2-rho^2).
double curl_integral_of_order_zero(double C, double rho, double psi, double end_value) {
  const double turns = std::round(psi / (2 * std::numbers::pi));
  const double rest = psi - turns * 2 * std::numbers::pi;
  double whole = 0;
  if (turns != 0) whole = turns * 2 * std::numbers::pi / std::sqrt((C - rho) * (C + rho));
  const double c = std::cos(rest / 2), s = std::sin(rest / 2);
  const double eps = (C - rho) / (C + rho);
  if (std::abs(c) < 1e-3) {
    // T is nearly infinite, which requires C > rho: atan(sqrt(eps) s/c) without the quotient.
    return whole + 2 / std::sqrt((C - rho) * (C + rho)) *
                       std::copysign(std::atan2(std::sqrt(eps) * std::abs(s), std::abs(c)), rest);
  }
  const double t = s / c;
  const double one_plus_z = end_value / (c * c * (C + rho));
  return whole + 2 * t / (C + rho) * arc_tangent_ratio(eps * t * t, one_plus_z);
}

void curl_integrals(double C, double rho, double psi, double end_value, std::span<Complex> out) {
  if (out.empty()) return;
  const double k0 = curl_integral_of_order_zero(C, rho, psi, end_value);
  double log_lambda = 0;  // |lambda| = 1 for |C| <= rho
  if (C > rho) {
    log_lambda = rho > 0 ? std::log((C + std::sqrt((C - rho) * (C + rho))) / rho) : INFINITY;
  }
  if (static_cast<double>(out.size()) * log_lambda < 3) {
    run_forward(C, rho, psi, end_value, k0, out);
  } else {
    solve_tridiagonal(C, rho, psi, end_value, k0, std::max(log_lambda, 1e-3), out);
  }
}

}  // namespace rholm
