// Integrals over the colatitude of functions on equiangular rings, as sums over few other rings.
//
// The terms F(theta) of order m of a function of degree D continue over the poles as a
// trigonometric polynomial of degree D, F(-theta) = (-1)^m F(theta), which n rings determine. It is
// evaluated on N >= D + L + 1 rings, where Fejer's rule is exact for F Pt_lm, l <= L; multiplied by
// its weights; and what is left of that beyond the frequencies of Pt_lm, which is orthogonal to it,
// is taken off: L + 1 rings then give the same sums as the N.
#pragma once

#include <complex>
#include <cstddef>
#include <vector>

#include "base/aligned_array.h"
#include "harmonic/fft/fft.h"
#include "rholm/grid.h"

namespace rholm {

class RingResampler {
 public:
  // Of an equiangular grid, for degrees up to L <= exact_degree(grid).
  RingResampler(const Grid& grid, int degree);

  // theta_q = (q + 1/2) pi / n_rings().
  std::size_t n_rings() const { return to_.rings; }

  struct Work {
    explicit Work(const RingResampler& resampler);
    AlignedArray<std::complex<double>> in, out;
  };
  // values[i], i < n_theta, becomes values[q], q < n_rings(): int F Pt sin dtheta is the sum of
  // values[q] Pt_lm(theta_q). `values` has room for the longer of the two.
  void run(int m, std::complex<double>* values, Work& work) const;

 private:
  // Rings and their mirror images beyond the poles: 2 pi j / length + offset.
  struct Circle {
    std::size_t rings, length;
    double offset;
    ComplexFft<double> fft;
  };
  // Frequencies |k| <= top, from one circle to another; the results are in work.out.
  struct Move {
    std::vector<std::complex<double>> factor;  // k = 0 ... top
  };
  static Move make_move(const Circle& from, const Circle& to, std::size_t top, double scale);
  static void apply(const Move& move, const Circle& from, const Circle& to, Work& work);

  bool poles_;
  Circle from_, middle_, to_;
  Move up_, down_;
  std::vector<double> weights_;
};

}  // namespace rholm
