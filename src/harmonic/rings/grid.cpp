#include "rholm/grid.h"

#include <algorithm>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "base/aligned_array.h"
#include "harmonic/fft/fft.h"
#include "harmonic/rings/ring_pairs.h"
#include "harmonic/rings/ring_rules.h"
#include "harmonic/rings/ring_sums.h"
#include "rholm/error.h"

namespace rholm {
namespace {

// Turns integrals over the colatitude of functions on equiangular rings into sums over fewer rings.
//
// The terms F(theta) of order m of a function of degree D continue over the poles as a
// trigonometric polynomial of degree D. With F(-theta) = (-1)^m F(theta), n rings determine it. F
// is evaluated on N >= D + L + 1 rings, where Fejer's rule is exact for F Pt_lm, l <= L, and is
// multiplied by the weights. Frequencies of the product above L are orthogonal to Pt_lm and are
// removed. L + 1 rings then give the same sums as the N rings.
class RingResampler {
 public:
  // Takes an equiangular grid, for degrees up to L <= exact_degree(grid).
  RingResampler(const Grid& grid, int degree);

  // The rings are at theta_q = (q + 1/2) pi / n_rings().
  std::size_t n_rings() const { return to_.rings; }

  struct Work {
    explicit Work(const RingResampler& resampler);
    AlignedArray<std::complex<double>> in, out;
  };
  // Turns values[i], i < n_theta, into values[q], q < n_rings(), so that int F Pt sin dtheta is the
  // sum of values[q] Pt_lm(theta_q). `values` has room for the longer of the two.
  void run(int m, std::complex<double>* values, Work& work) const;

 private:
  // Rings and their mirror images beyond the poles, at angles 2 pi j / length + offset.
  struct Circle {
    std::size_t rings, length;
    double offset;
    ComplexFft<double> fft;
  };
  // Factors that move frequencies |k| <= top between circles; the results are in work.out.
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

using Complex = std::complex<double>;

double half_step(std::size_t rings) { return std::numbers::pi / (2 * static_cast<double>(rings)); }

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
  // Frequency k is stored at -k, so that a forward transform computes the inverse.
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

constexpr std::size_t kOrdersPerTask = 8;  // chosen: a cache line of Coefficients
constexpr double kFourierPart = 0.3;       // part of the time, measured, for the progress

void check_grid(const Grid& grid) {
  const int least = grid.kind == GridKind::kEquiangularWithPoles ? 2 : 1;
  constexpr int kMost = 4 * (kMaxDegree + 1);
  if (grid.n_theta < least || grid.n_theta > kMost) {
    throw Error(ErrorCode::kInvalidInput, "a grid of " + std::to_string(grid.n_theta) +
                                              " rings: there must be " + std::to_string(least) +
                                              " to " + std::to_string(kMost));
  }
  if (grid.n_phi < 1 || grid.n_phi > kMost) {
    throw Error(ErrorCode::kInvalidInput, "a grid of " + std::to_string(grid.n_phi) +
                                              " longitudes: there must be 1 to " +
                                              std::to_string(kMost));
  }
}

// Rows of one order over the northern rings, in the layout of ring_sums.h.
struct OrderRows {
  explicit OrderRows(std::size_t padded) {
    for (auto& part : parts) {
      part = AlignedArray<double>(padded);
      std::fill(part.begin(), part.end(), 0.0);
    }
  }
  AlignedArray<double> parts[4];
};

// Copies of the data of one task's orders side by side: in RingPairs and Coefficients, the numbers
// of one order are far apart in memory.
class OrderBlock {
 public:
  OrderBlock(const RingPairs& pairs, std::size_t begin, std::size_t end)
      : begin_(begin),
        count_(end - begin),
        n_pairs_(pairs.n_pairs),
        orders_(pairs.orders),
        pairs_(4 * n_pairs_ * count_),
        c_(orders_ * count_),
        s_(orders_ * count_) {}

  double* at(std::size_t pair, std::size_t m) { return &pairs_[4 * (pair * count_ + m - begin_)]; }
  // Arrays with index l - m.
  double* c(std::size_t m) { return &c_[(m - begin_) * orders_]; }
  double* s(std::size_t m) { return &s_[(m - begin_) * orders_]; }

  void load(RingPairs& pairs) {
    for (std::size_t i = 0; i < n_pairs_; ++i) {
      std::copy_n(pairs.at(i, begin_), 4 * count_, at(i, begin_));
    }
  }
  void store(RingPairs& pairs) {
    for (std::size_t i = 0; i < n_pairs_; ++i) {
      std::copy_n(at(i, begin_), 4 * count_, pairs.at(i, begin_));
    }
  }
  // Calls visit(l, m, c, s) for the coefficients, degree by degree.
  template <typename Visit>
  void visit_coefficients(const Visit& visit) {
    for (std::size_t l = begin_; l < orders_; ++l) {
      const std::size_t end = std::min(begin_ + count_, l + 1);
      for (std::size_t m = begin_; m < end; ++m) {
        visit(static_cast<int>(l), static_cast<int>(m), c(m)[l - m], s(m)[l - m]);
      }
    }
  }

 private:
  std::size_t begin_, count_, n_pairs_, orders_;
  AlignedArray<double> pairs_;
  std::vector<double> c_, s_;
};

HalfRings north_of(const std::vector<double>& colatitudes) {
  return HalfRings(std::span(colatitudes).first((colatitudes.size() + 1) / 2));
}

// Integrates over the colatitude for each order: turns the sums of `pairs` into coefficients.
class OrderAnalysis {
 public:
  OrderAnalysis(const Grid& grid, int degree)
      : rule_(grid.kind == GridKind::kGaussLegendre
                  ? gauss_ring_rule(static_cast<std::size_t>(grid.n_theta))
                  : RingRule{}),
        resampler_(grid.kind == GridKind::kGaussLegendre
                       ? std::nullopt
                       : std::optional<RingResampler>(std::in_place, grid, degree)),
        rings_(north_of(resampler_ ? fejer_ring_rule(resampler_->n_rings()).colatitudes
                                   : rule_.colatitudes)),
        tables_(degree),
        step_(2 * std::numbers::pi / grid.n_phi) {}

  void run(RingPairs& pairs, std::size_t begin, std::size_t end, Coefficients& result) const {
    OrderRows rows(rings_.padded);
    RingOrder order;
    OrderBlock block(pairs, begin, end);
    block.load(pairs);
    std::vector<std::complex<double>> circle;
    std::optional<RingResampler::Work> work;
    if (resampler_) {
      circle.resize(std::max(pairs.n_theta, resampler_->n_rings()));
      work.emplace(*resampler_);
    }
    for (std::size_t m = begin; m < end; ++m) {
      if (resampler_) {
        gather_resampled(block, pairs.n_theta, m, circle.data(), *work, rows);
      } else {
        gather_weighted(block, m, rows);
      }
      set_ring_order(tables_, static_cast<int>(m), order);
      ring_adjoint(order, rings_, rows.parts[0].data(), rows.parts[1].data(), rows.parts[2].data(),
                   rows.parts[3].data(), block.c(m), block.s(m));
    }
    block.visit_coefficients([&](int l, int m, double c, double s) {
      result.c(l, m) = step_ * c;
      if (m > 0) result.s(l, m) = step_ * s;
    });
  }

 private:
  void gather_weighted(OrderBlock& block, std::size_t m, OrderRows& rows) const {
    for (std::size_t i = 0; i < rings_.size; ++i) {
      const double* at = block.at(i, m);
      for (int part = 0; part < 4; ++part) rows.parts[part][i] = rule_.weights[i] * at[part];
    }
  }

  void gather_resampled(OrderBlock& block, std::size_t n_theta, std::size_t m,
                        std::complex<double>* circle, RingResampler::Work& work,
                        OrderRows& rows) const {
    for (std::size_t i = 0; 2 * i < n_theta; ++i) {
      const double* at = block.at(i, m);
      const std::complex<double> even = {at[0], at[1]}, odd = {at[2], at[3]};
      const std::size_t mirror = n_theta - 1 - i;
      circle[i] = mirror == i ? even : 0.5 * (even + odd);
      if (mirror != i) circle[mirror] = 0.5 * (even - odd);
    }
    resampler_->run(static_cast<int>(m), circle, work);
    const std::size_t n = resampler_->n_rings();
    for (std::size_t i = 0; i < rings_.size; ++i) {
      const std::complex<double> north = circle[i], south = circle[n - 1 - i];
      const bool equator = 2 * i + 1 == n;
      const std::complex<double> even = equator ? north : north + south, odd = north - south;
      rows.parts[0][i] = even.real();
      rows.parts[1][i] = even.imag();
      rows.parts[2][i] = odd.real();
      rows.parts[3][i] = odd.imag();
    }
  }

  RingRule rule_;
  std::optional<RingResampler> resampler_;
  HalfRings rings_;
  RingTables tables_;
  double step_;
};

}  // namespace

int exact_degree(const Grid& grid) {
  const int of_theta = grid.kind == GridKind::kEquiangularWithPoles ? 2 : 1;
  return std::min(grid.n_theta - of_theta, grid.n_phi >= 1 ? (grid.n_phi - 1) / 2 : -1);
}

Grid smallest_grid(GridKind kind, int degree) {
  if (degree < 0 || degree > kMaxDegree) {
    throw Error(ErrorCode::kInvalidInput, "degree " + std::to_string(degree) +
                                              " is out of range: choose one from 0 to " +
                                              std::to_string(kMaxDegree));
  }
  const int more = kind == GridKind::kEquiangularWithPoles ? 2 : 1;
  return {kind, degree + more,
          static_cast<int>(smooth_length(2 * static_cast<std::size_t>(degree) + 1))};
}

std::vector<double> grid_colatitudes(const Grid& grid) {
  check_grid(grid);
  const std::size_t n = static_cast<std::size_t>(grid.n_theta);
  if (grid.kind == GridKind::kGaussLegendre) return gauss_ring_rule(n).colatitudes;
  std::vector<double> colatitudes(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double at = static_cast<double>(i);
    colatitudes[i] = grid.kind == GridKind::kEquiangular
                         ? (at + 0.5) * std::numbers::pi / grid.n_theta
                         : at * std::numbers::pi / (grid.n_theta - 1);
  }
  return colatitudes;
}

std::vector<double> synthesize_grid(const Coefficients& coefficients, const Grid& grid,
                                    const Context& context) {
  check_grid(grid);
  const int degree = coefficients.degree();
  if (grid.n_phi < 2 * degree + 1) {
    throw Error(ErrorCode::kInvalidInput,
                std::to_string(grid.n_phi) + " longitudes cannot hold degree " +
                    std::to_string(degree) + ": take at least " + std::to_string(2 * degree + 1));
  }
  RingPairs pairs(static_cast<std::size_t>(grid.n_theta), static_cast<std::size_t>(grid.n_phi),
                  degree);
  const HalfRings rings = north_of(grid_colatitudes(grid));
  const RingTables tables(degree);
  const auto evaluate_orders = [&](std::size_t begin, std::size_t end) {
    OrderRows rows(rings.padded);
    RingOrder order;
    OrderBlock block(pairs, begin, end);
    block.visit_coefficients([&](int l, int m, double& c, double& s) {
      c = coefficients.c(l, m);
      s = m > 0 ? coefficients.s(l, m) : 0;
    });
    for (std::size_t m = begin; m < end; ++m) {
      set_ring_order(tables, static_cast<int>(m), order);
      ring_forward(order, rings, block.c(m), block.s(m), rows.parts[0].data(), rows.parts[1].data(),
                   rows.parts[2].data(), rows.parts[3].data());
      for (std::size_t i = 0; i < rings.size; ++i) {
        for (int part = 0; part < 4; ++part) block.at(i, m)[part] = rows.parts[part][i];
      }
    }
    block.store(pairs);
  };
  parallel_for(pairs.orders, kOrdersPerTask, context, {"transform", 0, 1 - kFourierPart},
               evaluate_orders);
  std::vector<double> values(pairs.n_theta * pairs.n_phi);
  pairs_to_values(pairs, values, context, {"transform", 1 - kFourierPart, 1});
  return values;
}

Coefficients analyze_grid(std::span<const double> values, const Grid& grid, int degree,
                          const Context& context) {
  check_grid(grid);
  const std::size_t n_theta = static_cast<std::size_t>(grid.n_theta);
  const std::size_t n_phi = static_cast<std::size_t>(grid.n_phi);
  if (values.size() != n_theta * n_phi) {
    throw Error(ErrorCode::kInvalidInput, "a grid of " + std::to_string(n_theta) + " times " +
                                              std::to_string(n_phi) + " has not " +
                                              std::to_string(values.size()) + " values");
  }
  Coefficients result(degree);
  if (degree > exact_degree(grid)) {
    throw Error(ErrorCode::kInvalidInput,
                "degree " + std::to_string(degree) + " is too high for a grid of " +
                    std::to_string(n_theta) + " times " + std::to_string(n_phi) +
                    ": choose at most " + std::to_string(exact_degree(grid)) + ", or a finer grid");
  }
  RingPairs pairs(n_theta, n_phi, degree);
  values_to_pairs(values, pairs, context, {"transform", 0, kFourierPart});
  const OrderAnalysis analysis(grid, degree);
  parallel_for(
      pairs.orders, kOrdersPerTask, context, {"transform", kFourierPart, 1},
      [&](std::size_t begin, std::size_t end) { analysis.run(pairs, begin, end, result); });
  return result;
}

}  // namespace rholm
