// Values on rings of constant colatitude: Legendre sums per ring, then a Fourier sum in phi.
#include <cmath>
#include <numbers>

#include "harmonic/order_sums.h"
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
  // cos and sin of 2 pi k / n_phi; the index m k is taken modulo n_phi, exactly.
  std::vector<double> cosine(columns), sine(columns);
  for (std::size_t k = 0; k < columns; ++k) {
    const double phi = 2 * std::numbers::pi * static_cast<double>(k) / n_phi;
    cosine[k] = std::cos(phi);
    sine[k] = std::sin(phi);
  }
  const DirectionBlock block(colatitudes);
  std::vector<OrderTable> tables(1);
  tables[0].reset(degree, block);
  evaluate_orders(block, {&coefficients, 1}, tables, context, {"transform", 0, 0.5});
  std::vector<double> values(colatitudes.size() * columns, 0.0);
  parallel_for(colatitudes.size(), 1, context, {"transform", 0.5, 1},
               [&](std::size_t begin, std::size_t end) {
                 for (std::size_t i = begin; i < end; ++i) {
                   double* row = values.data() + i * columns;
                   for (int m = 0; m <= degree; ++m) {
                     const double re = tables[0].re_row(m)[i], im = tables[0].im_row(m)[i];
                     const std::size_t step = static_cast<std::size_t>(m) % columns;
                     for (std::size_t k = 0, at = 0; k < columns; ++k) {
                       row[k] += re * cosine[at] + im * sine[at];
                       at += step;
                       if (at >= columns) at -= columns;
                     }
                   }
                 }
               });
  return values;
}

}  // namespace rholm
