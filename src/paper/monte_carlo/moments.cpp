#include "paper/monte_carlo/moments.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/stopwatch.h"
#include "harmonic/legendre/legendre_kernels.h"
#include "harmonic/legendre/legendre_pairs.h"
#include "harmonic/legendre/order_sums.h"

namespace rholm {
namespace {

constexpr std::size_t kPairsPerTask = 32;  // chosen: about 0.1 ms at L = 64
constexpr std::size_t kTile = 8;           // tables are written by cache lines
constexpr std::size_t kOrdersPerTask = 4;  // as in order_sums.cpp

// The two samples of each pair in a block.
struct PairBlock {
  std::array<std::vector<Vec3>, 2> directions;
  std::array<OrderTable, 2> tables;
};

// Draws pairs `first` ... `first + n`; consecutive numbers run through the places first.
void draw_block(const DrawSample& draw, std::size_t places, std::size_t first, std::size_t n,
                int degree, PairBlock& block, const Context& context) {
  const std::vector<Vec3> anywhere(n, Vec3{0, 0, 1});
  const DirectionBlock size(anywhere);
  for (int side = 0; side < 2; ++side) {
    block.directions[side].resize(n);
    block.tables[side].reset(degree, size);
  }
  parallel_for(n, kPairsPerTask, context, {}, [&](std::size_t begin, std::size_t end) {
    SampleScratch scratch;
    std::array<std::vector<std::complex<double>>, kTile> tile;
    for (std::size_t at = begin; at < end; at += kTile) {
      const std::size_t tiled = std::min(kTile, end - at);
      for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t i = 0; i < tiled; ++i) {
          const std::size_t place = (first + at + i) % places, pair = (first + at + i) / places;
          scratch.terms.resize(degree + std::size_t{1});
          block.directions[side][at + i] = draw(place, 2 * pair + side, scratch);
          std::swap(scratch.terms, tile[i]);
        }
        for (int m = 0; m <= degree; ++m) {
          for (std::size_t i = 0; i < tiled; ++i) {
            block.tables[side].re_row(m)[at + i] = tile[i][m].real();
            block.tables[side].im_row(m)[at + i] = tile[i][m].imag();
          }
        }
      }
    }
  });
}

// Sums for the cosine and sine coefficients of one order, with index l - m.
struct OrderMoments {
  explicit OrderMoments(std::size_t rows) {
    for (std::vector<double>& row : values) row.assign(rows, 0.0);
  }
  PairMoments c() { return {values[0].data(), values[1].data(), values[2].data()}; }
  PairMoments s() { return {values[3].data(), values[4].data(), values[5].data()}; }

  std::array<std::vector<double>, 6> values;
};

void add_order(OrderMoments& order, int m, Moments& moments) {
  const std::array<Coefficients*, 3> to = {&moments.sum, &moments.square, &moments.fourth};
  for (std::size_t i = 0; i < 3; ++i) {
    for (int l = m; l <= moments.sum.degree(); ++l) {
      to[i]->c(l, m) += order.values[i][l - m];
      if (m > 0) to[i]->s(l, m) += order.values[3 + i][l - m];
    }
  }
}

void add_block(const PairBlock& block, Moments& moments, const Context& context) {
  const int degree = moments.sum.degree();
  const std::vector<double> mu = legendre_mu(degree);
  const std::array<DirectionBlock, 2> sides = {DirectionBlock(block.directions[0]),
                                               DirectionBlock(block.directions[1])};
  parallel_for(mu.size(), kOrdersPerTask, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int m = static_cast<int>(i);
      const auto side = [&](int k) {
        return PairSide{.x = sides[k].cos_theta.data(),
                        .s = sides[k].sin_theta.data(),
                        .re = block.tables[k].re_row(m),
                        .im = block.tables[k].im_row(m)};
      };
      OrderMoments sums(static_cast<std::size_t>(degree - m) + 1);
      legendre_pair_moments(legendre_order(m, degree, mu[i]), side(0), side(1), sides[0].padded,
                            sums.c(), sums.s());
      add_order(sums, m, moments);
    }
  });
}

// Returns function(sum, square, fourth) for every coefficient.
template <typename Function>
Coefficients map(const Moments& moments, const Function& function) {
  Coefficients result(moments.sum.degree());
  for (std::size_t i = 0; i < result.values().size(); ++i) {
    result.values()[i] =
        function(moments.sum.values()[i], moments.square.values()[i], moments.fourth.values()[i]);
  }
  return result;
}

}  // namespace

void add_samples(const DrawSample& draw, std::size_t places, std::size_t samples, Moments& moments,
                 StageTimes& times, const Context& context, const ParallelStage& stage) {
  const int degree = moments.sum.degree();
  const std::size_t begin = places * (moments.samples / 2), end = begin + places * (samples / 2);
  const std::size_t chunk = chunk_size(degree) / 2;  // two tables at once
  const Context silent{.threads = context.threads};
  PairBlock block;
  for (std::size_t first = begin; first < end; first += chunk) {
    const std::size_t n = std::min(chunk, end - first);
    {
      const StageTimer timer(times, "samples");
      draw_block(draw, places, first, n, degree, block, silent);
    }
    {
      const StageTimer timer(times, "sums");
      add_block(block, moments, silent);
    }
    const double part = static_cast<double>(first + n - begin) / static_cast<double>(end - begin);
    report_progress(context, stage.name, stage.from + part * (stage.to - stage.from));
  }
  moments.samples += samples;
}

Coefficients mean_of(const Moments& moments) {
  const double n = static_cast<double>(moments.samples);
  return map(moments, [n](double sum, double, double) { return sum / n; });
}

Coefficients standard_error_of(const Moments& moments) {
  const double n = static_cast<double>(moments.samples);
  return map(moments, [n](double, double square, double) { return std::sqrt(square) / n; });
}

double student_factor(double nu) {
  // The formula is fitted to the exact quantiles, within 0.4 % for nu >= 1.
  const double x = 1 / nu;
  return std::exp(x * (2.48666 + x * (3.05423 + x * (-1.28467 + x * 0.10466))));
}

Coefficients deviation_of(const Moments& moments) {
  const double n = static_cast<double>(moments.samples);
  return map(moments, [n](double, double square, double fourth) {
    if (!(square > 0)) return 0.0;
    // Satterthwaite's degrees of freedom are (sum v)^2 / sum v^2 for normal pairs with variances v.
    // With one degree of freedom, squares of estimates of v are 3 times too large. The square of
    // their sum is too large by the relative amount 2 / nu, which gives 3 square^2 / fourth - 2.
    // For few pairs this is uncertain. Measured with 1000 seeds each: with 2 taken away 99.0 % of
    // the coefficients are within 3 deviations at 2 points per edge of an octahedron. With 5 it is
    // 99.6 to 99.9 % at 2, 4, 8 and 32 points on edges and faces of octahedra and a tetrahedron.
    const double nu = 3 * square * square / std::max(fourth, 1e-300) - 5;
    return std::sqrt(square) / n * student_factor(std::max(nu, 1.0));
  });
}

}  // namespace rholm
