#include "harmonic/nonuniform/sphere_fourier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "harmonic/fft/fft.h"
#include "harmonic/nonuniform/circle_kernels.h"
#include "harmonic/rings/ring_sums.h"

namespace rholm {
namespace {

constexpr double kPi = std::numbers::pi;
using Complex = std::complex<double>;

constexpr std::size_t kRowsPerTask = 8;  // chosen: about 20 us
// Chosen: several blocks share the work arrays of a task; pairs of orders stay together.
constexpr int kOrdersPerTask = 2 * kOrderBlock;

// Transforms and factors that all orders share.
template <typename T>
struct Circle {
  std::size_t n_theta, n_rings;
  ComplexFft<T> grid_fft, ring_fft;
  // e^{-ik (w/2) h} e^{-i k pi/(2n)} / (2 n window(k)) for k = 0 ... L and for k = -L ... -1: takes
  // waves on the grid to waves on the rings.
  Factors<T> factors, negative_factors;

  explicit Circle(const SphereFourier& f)
      : n_theta(f.layout.n_theta),
        n_rings(f.n_rings),
        grid_fft(n_theta),
        ring_fft(2 * n_rings),
        factors(f.degree + std::size_t{1}),
        negative_factors(f.degree) {
    const double step = 2 * kPi / static_cast<double>(n_theta);
    const double per_wave = step * f.layout.width / 2 + kPi / (2 * static_cast<double>(n_rings));
    for (int k = 0; k <= f.degree; ++k) {
      const double size = 1 / (2 * static_cast<double>(n_rings) * f.theta.fourier(k));
      const double re = size * std::cos(k * per_wave), im = -size * std::sin(k * per_wave);
      factors.set(k, re, im);
      if (k > 0) negative_factors.set(f.degree - k, re, -im);
    }
  }

  // Fills `to`, a circle of n_to waves, from a circle of n_from waves.
  void copy_waves(const T* from, std::size_t n_from, T* to, std::size_t n_to) const {
    const std::size_t used = factors.size, negative = negative_factors.size;
    multiply(factors, from, to);
    std::fill(to + 2 * used, to + 2 * (n_to - negative), T{0});
    multiply(negative_factors, from + 2 * (n_from - negative), to + 2 * (n_to - negative));
  }
};

// Returns e^{i m (w/2) h} / window(m), which includes the phase of the first column.
Complex phase_of_order(const SphereFourier& f, int m) {
  const double step = 2 * kPi / static_cast<double>(f.layout.n_phi);
  return std::polar(1 / f.phi.fourier(m), m * step * f.layout.width / 2);
}

// Work arrays of one task, and the steps that use them.
template <typename T>
class Orders {
 public:
  Orders(const SphereFourier& fourier, const Circle<T>& circle, const HalfRings& rings,
         const RingTables& tables)
      : fourier_(fourier),
        circle_(circle),
        rings_(rings),
        tables_(tables),
        degrees_(fourier.degree + std::size_t{1}),
        rows_(kParts * rings.padded),
        coefficients_(2 * kOrderBlock * degrees_) {
    const std::size_t longest = 2 * std::max(circle.n_theta, 2 * circle.n_rings);
    circles_ = AlignedArray<T>((kPairs + 2) * longest);
    for (int pair = 0; pair < kPairs; ++pair) circle_of_[pair] = circles_.data() + pair * longest;
    first_ = circles_.data() + kPairs * longest;
    second_ = first_ + longest;
    // Ring sums require zeros beyond the last ring.
    std::fill(rows_.begin(), rows_.end(), 0.0);
  }

  // Computes orders first ... first + count - 1 from rows of complex numbers. The rows hold zeros
  // for orders above the degree.
  void adjoint(const T* grid, int first, int count, Coefficients& sum) {
    gather_circles(fourier_.layout, grid + 2 * static_cast<std::size_t>(first), circle_of_.data());
    std::fill(coefficients_.begin(), coefficients_.end(), 0.0);
    for (int k = 0; k < count; k += 2) {
      circle_.grid_fft.forward(complex(circle_of_[k / 2]), complex(first_));
      circle_.copy_waves(first_, circle_.n_theta, second_, 2 * circle_.n_rings);
      circle_.ring_fft.forward(complex(second_), complex(first_));
      split_circle(first_, circle_.n_rings, parts(0), parts(1));
      for (int odd = 0; odd < 2 && k + odd < count; ++odd) {
        const RingParts p = parts(odd);
        set_ring_order(tables_, first + k + odd, order_);
        ring_adjoint(order_, rings_, p.even_re, p.even_im, p.odd_re, p.odd_im,
                     re_of(k + odd) + k + odd, im_of(k + odd) + k + odd);
      }
    }
    add_coefficients(first, count, sum);
  }

  void forward(const Coefficients& coefficients, int first, int count, T* grid) {
    take_coefficients(coefficients, first, count);
    for (int k = 0; k < kOrderBlock; k += 2) {
      for (int odd = 0; odd < 2; ++odd) evaluate_order(first + k + odd, k + odd, parts(odd));
      join_circle(parts(0), parts(1), circle_.n_rings, first_);
      circle_.ring_fft.forward(complex(first_), complex(second_));
      circle_.copy_waves(second_, 2 * circle_.n_rings, first_, circle_.n_theta);
      circle_.grid_fft.forward(complex(first_), complex(circle_of_[k / 2]));
    }
    scatter_circles(fourier_.layout, circle_of_.data(), grid + 2 * static_cast<std::size_t>(first));
  }

 private:
  static constexpr int kParts = 8;

  static std::complex<T>* complex(T* numbers) {
    return reinterpret_cast<std::complex<T>*>(numbers);
  }
  RingParts parts(int odd) {
    double* at = rows_.data() + odd * (4 * rings_.padded);
    return {at, at + rings_.padded, at + 2 * rings_.padded, at + 3 * rings_.padded};
  }
  // Coefficients of the k-th order of the block, with index l - first.
  double* re_of(int k) { return coefficients_.data() + 2 * (k * degrees_); }
  double* im_of(int k) { return re_of(k) + degrees_; }

  // Calls visit(l, k) for the degrees of the block's orders: all orders of one degree together, as
  // Coefficients stores them.
  template <typename Visit>
  void visit_coefficients(int first, int count, const Visit& visit) {
    for (int l = first; l <= fourier_.degree; ++l) {
      if (count == kOrderBlock && l >= first + kOrderBlock - 1) {
        for (int k = 0; k < kOrderBlock; ++k) visit(l, k);
      } else {
        for (int k = 0; k < count && first + k <= l; ++k) visit(l, k);
      }
    }
  }

  void add_coefficients(int first, int count, Coefficients& sum) {
    if (first == 0) std::fill(im_of(0), im_of(0) + degrees_, 0.0);
    std::array<double, kOrderBlock> re{}, im{};
    for (int k = 0; k < count; ++k) {
      // The circle contains each order twice, in a + b and in a - b.
      const Complex phase = 0.5 * phase_of_order(fourier_, first + k);
      re[k] = phase.real();
      im[k] = phase.imag();
    }
    visit_coefficients(first, count, [&](int l, int k) {
      const double a = re_of(k)[l - first], b = im_of(k)[l - first];
      sum.c(l, first + k) += re[k] * a - im[k] * b;
      // The transform has e^{-i m phi}: its imaginary part belongs to -sin.
      sum.s(l, first + k) -= re[k] * b + im[k] * a;
    });
  }

  // Does the transpose of add_coefficients().
  void take_coefficients(const Coefficients& coefficients, int first, int count) {
    std::array<double, kOrderBlock> re{}, im{};
    for (int k = 0; k < count; ++k) {
      // The inverse real transform counts every order except 0 twice, as m and -m.
      const Complex phase =
          (first + k == 0 ? 0.5 : 0.25) * std::conj(phase_of_order(fourier_, first + k));
      re[k] = phase.real();
      im[k] = phase.imag();
    }
    visit_coefficients(first, count, [&](int l, int k) {
      const double c = coefficients.c(l, first + k), s = coefficients.s(l, first + k);
      re_of(k)[l - first] = re[k] * c + im[k] * s;
      im_of(k)[l - first] = im[k] * c - re[k] * s;
    });
    if (first == 0) std::fill(im_of(0), im_of(0) + degrees_, 0.0);
  }

  void evaluate_order(int m, int k, const RingParts& p) {
    if (m > fourier_.degree) {
      std::fill(p.even_re, p.even_re + 4 * rings_.padded, 0.0);
      return;
    }
    set_ring_order(tables_, m, order_);
    ring_forward(order_, rings_, re_of(k) + k, im_of(k) + k, p.even_re, p.even_im, p.odd_re,
                 p.odd_im);
  }

  const SphereFourier& fourier_;
  const Circle<T>& circle_;
  const HalfRings& rings_;
  const RingTables& tables_;
  std::size_t degrees_;
  RingOrder order_;
  AlignedArray<double> rows_, coefficients_;
  AlignedArray<T> circles_;
  std::array<T*, kPairs> circle_of_;
  T *first_, *second_;
};

HalfRings half_rings(const SphereFourier& fourier) {
  std::vector<double> colatitudes;
  for (std::size_t q = 0; 2 * q < fourier.n_rings; ++q) {
    colatitudes.push_back((static_cast<double>(q) + 0.5) * kPi /
                          static_cast<double>(fourier.n_rings));
  }
  return HalfRings(colatitudes);
}

// Calls work(orders, first, count) for all blocks of orders.
template <typename T, typename Work>
void for_each_block(const SphereFourier& fourier, const Context& context,
                    const ParallelStage& stage, const Work& work) {
  const Circle<T> circle(fourier);
  const HalfRings rings = half_rings(fourier);
  const RingTables tables(fourier.degree);
  const std::size_t n = fourier.degree + std::size_t{1};
  parallel_for(n, kOrdersPerTask, context, stage, [&](std::size_t begin, std::size_t end) {
    Orders<T> orders(fourier, circle, rings, tables);
    for (std::size_t first = begin; first < end; first += kOrderBlock) {
      work(orders, static_cast<int>(first),
           static_cast<int>(std::min<std::size_t>(kOrderBlock, end - first)));
    }
  });
}

}  // namespace

SphereFourier sphere_fourier(int degree, const GridLayout& layout) {
  const auto band = static_cast<std::size_t>(degree);
  return {.degree = degree,
          .layout = layout,
          .theta = spread_window(layout.width, band, layout.n_theta),
          .phi = spread_window(layout.width, band, layout.n_phi),
          .n_rings = smooth_length(std::max<std::size_t>(2 * (band + 1), 32), 4) / 2};
}

template <typename T>
GridKernel<T> grid_kernel(const SphereFourier& fourier) {
  return {.layout = fourier.layout,
          .theta = spread_table<T>(fourier.theta),
          .phi = spread_table<T>(fourier.phi)};
}

void grid_to_coefficients(const SphereFourier& fourier, std::span<double* const> grids,
                          Coefficients& sum, const Context& context, const ParallelStage& stage) {
  const GridLayout& layout = fourier.layout;
  const RealFft<double> fft(layout.n_phi);
  const std::size_t used = fourier.degree + std::size_t{1};
  const std::size_t whole = (used + kOrderBlock - 1) / kOrderBlock * kOrderBlock;
  const double middle = stage.from + 0.3 * (stage.to - stage.from);  // measured share
  parallel_for(layout.rows, kRowsPerTask, context, {stage.name, stage.from, middle},
               [&](std::size_t begin, std::size_t end) {
                 AlignedArray<double> work(layout.stride);
                 for (std::size_t row = begin; row < end; ++row) {
                   double* values = grids[0] + row * layout.stride;
                   for (std::size_t g = 1; g < grids.size(); ++g) {
                     const double* more = grids[g] + row * layout.stride;
                     for (std::size_t c = 0; c < layout.stride; ++c) values[c] += more[c];
                   }
                   // Adds the columns of the next turn.
                   for (std::size_t c = layout.n_phi; c < layout.stride; ++c) {
                     values[c - layout.n_phi] += values[c];
                   }
                   fft.forward(values, used, work.data());
                   // Fills up to whole blocks of orders.
                   std::fill(values + 2 * used, values + 2 * whole, 0.0);
                 }
               });
  for_each_block<double>(fourier, context, {stage.name, middle, stage.to},
                         [&](Orders<double>& orders, int first, int count) {
                           orders.adjoint(grids[0], first, count, sum);
                         });
}

template <typename T>
void coefficients_to_grid(const SphereFourier& fourier, const Coefficients& coefficients, T* grid,
                          const Context& context, const ParallelStage& stage) {
  const GridLayout& layout = fourier.layout;
  const double middle = stage.from + 0.7 * (stage.to - stage.from);  // measured share
  for_each_block<T>(fourier, context, {stage.name, stage.from, middle},
                    [&](Orders<T>& orders, int first, int count) {
                      orders.forward(coefficients, first, count, grid);
                    });
  const RealFft<T> fft(layout.n_phi);
  const std::size_t used = fourier.degree + std::size_t{1};
  parallel_for(layout.rows, kRowsPerTask, context, {stage.name, middle, stage.to},
               [&](std::size_t begin, std::size_t end) {
                 AlignedArray<T> work(layout.stride);
                 for (std::size_t row = begin; row < end; ++row) {
                   T* values = grid + row * layout.stride;
                   fft.backward(values, used, work.data());
                   for (std::size_t c = layout.n_phi; c < layout.stride; ++c) {
                     values[c] = values[c - layout.n_phi];
                   }
                 }
               });
}

template GridKernel<float> grid_kernel(const SphereFourier&);
template GridKernel<double> grid_kernel(const SphereFourier&);
template void coefficients_to_grid(const SphereFourier&, const Coefficients&, float*,
                                   const Context&, const ParallelStage&);
template void coefficients_to_grid(const SphereFourier&, const Coefficients&, double*,
                                   const Context&, const ParallelStage&);

}  // namespace rholm
