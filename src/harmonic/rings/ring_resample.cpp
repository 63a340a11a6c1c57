#include "harmonic/rings/ring_resample.h"

#include <algorithm>
#include <numbers>

#include "harmonic/rings/ring_rules.h"

namespace rholm {
namespace {

using Complex = std::complex<double>;

double half_step(std::size_t rings) { return std::numbers::pi / (2 * static_cast<double>(rings)); }

}  // namespace

RingResampler::RingResampler(const Grid& grid, int degree)
    : poles_(grid.kind == GridKind::kEquiangularWithPoles),
      from_([&] {
        const std::size_t n = static_cast<std::size_t>(grid.n_theta);
        const std::size_t length = poles_ ? 2 * (n - 1) : 2 * n;
        return Circle{n, length, poles_ ? 0.0 : half_step(n), ComplexFft<double>(length)};
      }()),
      middle_([&] {
        const std::size_t n =
            smooth_length(static_cast<std::size_t>(grid.n_theta) + degree + std::size_t{1});
        return Circle{n, 2 * n, half_step(n), ComplexFft<double>(2 * n)};
      }()),
      to_([&] {
        const std::size_t n = smooth_length(degree + std::size_t{1});
        return Circle{n, 2 * n, half_step(n), ComplexFft<double>(2 * n)};
      }()),
      up_(make_move(from_, middle_, from_.rings - (poles_ ? 2 : 1), 1)),
      down_(make_move(middle_, to_, static_cast<std::size_t>(degree),
                      static_cast<double>(middle_.rings) / static_cast<double>(to_.rings))),
      weights_(fejer_ring_rule(middle_.rings).weights) {}

RingResampler::Work::Work(const RingResampler& resampler)
    : in(std::max({resampler.from_.length, resampler.middle_.length, resampler.to_.length})),
      out(in.size()) {}

RingResampler::Move RingResampler::make_move(const Circle& from, const Circle& to, std::size_t top,
                                             double scale) {
  Move move;
  for (std::size_t k = 0; k <= top; ++k) {
    move.factor.push_back(std::polar(scale / static_cast<double>(from.length),
                                     static_cast<double>(k) * (to.offset - from.offset)));
  }
  return move;
}

void RingResampler::apply(const Move& move, const Circle& from, const Circle& to, Work& work) {
  from.fft.forward(work.in.data(), work.out.data());
  std::fill(work.in.data(), work.in.data() + to.length, Complex{});
  // Frequency k at -k: the transform back is the transform forth.
  work.in[0] = work.out[0] * move.factor[0];
  for (std::size_t k = 1; k < move.factor.size(); ++k) {
    work.in[to.length - k] = work.out[k] * move.factor[k];
    work.in[k] = work.out[from.length - k] * std::conj(move.factor[k]);
  }
  to.fft.forward(work.in.data(), work.out.data());
}

void RingResampler::run(int m, Complex* values, Work& work) const {
  const double sign = m % 2 == 0 ? 1 : -1;
  Complex* in = work.in.data();
  if (poles_) {
    // Odd orders vanish at the poles.
    for (std::size_t i = 0; i < from_.rings; ++i) {
      const bool pole = i == 0 || i + 1 == from_.rings;
      in[i] = pole && m % 2 == 1 ? Complex{} : values[i];
      if (!pole) in[from_.length - i] = sign * values[i];
    }
  } else {
    for (std::size_t i = 0; i < from_.rings; ++i) {
      in[i] = values[i];
      in[from_.length - 1 - i] = sign * values[i];
    }
  }
  apply(up_, from_, middle_, work);
  for (std::size_t i = 0; i < middle_.rings; ++i) {
    in[i] = work.out[i] * weights_[i];
    in[middle_.length - 1 - i] = work.out[middle_.length - 1 - i] * weights_[i];
  }
  apply(down_, middle_, to_, work);
  std::copy(work.out.data(), work.out.data() + to_.rings, values);
}

}  // namespace rholm
