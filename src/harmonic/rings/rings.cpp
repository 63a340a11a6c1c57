// Values on rings of constant colatitude: Legendre sums per ring, then a Fourier transform in phi.
#include <algorithm>
#include <complex>
#include <string>

#include "harmonic/fft/fft.h"
#include "harmonic/legendre/order_sums.h"
#include "rholm/error.h"
#include "rholm/harmonic.h"

namespace rholm {

std::vector<double> evaluate_rings(const Coefficients& coefficients,
                                   std::span<const double> colatitudes, int n_phi,
                                   const Context& context) {
  if (n_phi < 1) {
    throw Error(ErrorCode::kInvalidInput,
                "a ring needs at least 1 direction, not " + std::to_string(n_phi));
  }
  const int degree = coefficients.degree();
  const std::size_t columns = static_cast<std::size_t>(n_phi);
  const DirectionBlock block(colatitudes);
  std::vector<OrderTable> tables(1);
  tables[0].reset(degree, block);
  evaluate_orders(block, {&coefficients, 1}, tables, context, {"transform", 0, 0.8});
  std::vector<double> values(colatitudes.size() * columns);
  const ComplexFft<double> fft(columns);
  // re cos + im sin is the real part of (re + i im) e^{-i m phi}. Orders that are equal modulo
  // n_phi coincide on the ring.
  parallel_for(colatitudes.size(), 1, context, {"transform", 0.8, 1},
               [&](std::size_t begin, std::size_t end) {
                 AlignedArray<std::complex<double>> in(columns), out(columns);
                 for (std::size_t i = begin; i < end; ++i) {
                   std::fill(in.begin(), in.end(), 0.0);
                   for (int m = 0; m <= degree; ++m) {
                     in[static_cast<std::size_t>(m) % columns] +=
                         std::complex<double>(tables[0].re_row(m)[i], tables[0].im_row(m)[i]);
                   }
                   fft.forward(in.data(), out.data());
                   for (std::size_t k = 0; k < columns; ++k)
                     values[i * columns + k] = out[k].real();
                 }
               });
  return values;
}

}  // namespace rholm
