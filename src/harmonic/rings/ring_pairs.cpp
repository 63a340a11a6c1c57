#include "harmonic/rings/ring_pairs.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>

#include "harmonic/fft/fft.h"
#include "rholm/error.h"

namespace rholm {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t kPairsPerTask = 8;  // chosen: 50 us and more from L = 256 on

// The rows of values of a pair; `south` is empty for a ring on the equator.
template <typename Value>
struct Rows {
  std::span<Value> north, south;
};
template <typename Value>
Rows<Value> rows_of(std::span<Value> values, const RingPairs& pairs, std::size_t pair) {
  const std::size_t mirror = pairs.n_theta - 1 - pair;
  return {values.subspan(pair * pairs.n_phi, pairs.n_phi),
          mirror == pair ? std::span<Value>{} : values.subspan(mirror * pairs.n_phi, pairs.n_phi)};
}

void check_row(std::span<const double> row, std::size_t ring) {
  std::size_t finite = 0;
  for (const double value : row) finite += std::abs(value) <= std::numeric_limits<double>::max();
  if (finite == row.size()) return;
  const auto bad =
      std::find_if_not(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
  throw Error(ErrorCode::kInvalidInput, "the value at ring " + std::to_string(ring) +
                                            ", longitude " + std::to_string(bad - row.begin()) +
                                            " is not a finite number: fill it in before analysis");
}

}  // namespace

RingPairs::RingPairs(std::size_t rings, std::size_t longitudes, int degree)
    : n_theta(rings),
      n_phi(longitudes),
      orders(degree + std::size_t{1}),
      n_pairs((rings + 1) / 2),
      values(4 * n_pairs * orders) {}

void values_to_pairs(std::span<const double> values, RingPairs& pairs, const Context& context,
                     const ParallelStage& stage) {
  const std::size_t n = pairs.n_phi;
  const ComplexFft<double> fft(n);
  const auto transform = [&](std::size_t pair, Complex* in, Complex* out) {
    const auto [north, south] = rows_of(values, pairs, pair);
    check_row(north, pair);
    check_row(south, pairs.n_theta - 1 - pair);
    for (std::size_t k = 0; k < n; ++k) in[k] = {north[k], south.empty() ? 0.0 : south[k]};
    fft.forward(in, out);
    for (std::size_t m = 0; m < pairs.orders; ++m) {
      const Complex z = out[m], mirror = std::conj(out[m == 0 ? 0 : n - m]);
      const Complex f = 0.5 * (z + mirror), g = Complex(0, -0.5) * (z - mirror);
      const Complex even = f + g, odd = south.empty() ? 0.0 : f - g;
      double* at = pairs.at(pair, m);
      at[0] = even.real();
      at[1] = -even.imag();
      at[2] = odd.real();
      at[3] = -odd.imag();
    }
  };
  parallel_for(pairs.n_pairs, kPairsPerTask, context, stage,
               [&](std::size_t begin, std::size_t end) {
                 AlignedArray<Complex> in(n), out(n);
                 for (std::size_t i = begin; i < end; ++i) transform(i, in.data(), out.data());
               });
}

void pairs_to_values(RingPairs& pairs, std::span<double> values, const Context& context,
                     const ParallelStage& stage) {
  const std::size_t n = pairs.n_phi;
  const ComplexFft<double> fft(n);
  const auto transform = [&](std::size_t pair, Complex* in, Complex* out) {
    const auto [north, south] = rows_of(values, pairs, pair);
    std::fill(in, in + n, Complex{});
    for (std::size_t m = 0; m < pairs.orders; ++m) {
      const double* at = pairs.at(pair, m);
      // re cos + im sin = h e^{-i m phi} + its conjugate
      const double half = m == 0 ? 1 : 0.5;
      const Complex even = {half * at[0], m == 0 ? 0 : half * at[1]};
      const Complex odd = {half * at[2], m == 0 ? 0 : half * at[3]};
      const Complex f = even + odd, g = even - odd;
      in[m] = f + Complex(0, 1) * g;
      if (m > 0) in[n - m] = std::conj(f) + Complex(0, 1) * std::conj(g);
    }
    fft.forward(in, out);
    for (std::size_t k = 0; k < n; ++k) north[k] = out[k].real();
    for (std::size_t k = 0; k < south.size(); ++k) south[k] = out[k].imag();
  };
  parallel_for(pairs.n_pairs, kPairsPerTask, context, stage,
               [&](std::size_t begin, std::size_t end) {
                 AlignedArray<Complex> in(n), out(n);
                 for (std::size_t i = begin; i < end; ++i) transform(i, in.data(), out.data());
               });
}

}  // namespace rholm
