#include "studio/items/degree_table.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "harmonic/legendre/legendre_degrees.h"
#include "harmonic/legendre/legendre_kernels.h"
#include "harmonic/legendre/order_sums.h"

namespace rholm::studio {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;  // chosen: small for a page's memory
constexpr double kMaxWork = 2e9;  // terms; chosen: some two seconds on one processor

// Directions of one block, with cosine and sine of m phi for the current order m.
struct Waves {
  explicit Waves(std::span<const Vec3> directions)
      : block(directions), cosine(block.padded, 1.0), sine(block.padded, 0.0) {}

  // Proceeds from order m - 1 to m.
  void next() {
    for (std::size_t k = 0; k < block.padded; ++k) {
      const double c = cosine[k] * block.cos_phi[k] - sine[k] * block.sin_phi[k];
      sine[k] = sine[k] * block.cos_phi[k] + cosine[k] * block.sin_phi[k];
      cosine[k] = c;
    }
  }

  DirectionBlock block;
  std::vector<double> cosine, sine;
};

// Coefficients and recurrence of one order.
struct Terms {
  LegendreOrder order;
  std::vector<double> cosine, sine;  // coefficients of l = m ... L
};

std::vector<Terms> terms_of(const Coefficients& coefficients) {
  const int degree = coefficients.degree();
  const std::vector<double> mu = legendre_mu(degree);
  std::vector<Terms> all;
  for (int m = 0; m <= degree; ++m) {
    Terms terms{legendre_order(m, degree, mu[m]), {}, {}};
    for (int l = m; l <= degree; ++l) {
      terms.cosine.push_back(coefficients.c(l, m));
      terms.sine.push_back(coefficients.s(l, m));
    }
    all.push_back(std::move(terms));
  }
  return all;
}

}  // namespace

bool DegreeTable::fits(std::size_t directions, int degree) {
  const double n = static_cast<double>(directions), l = degree + 1.0;
  return n * l * sizeof(float) <= static_cast<double>(kMaxBytes) && n * l * l / 2 <= kMaxWork;
}

DegreeTable::DegreeTable(const Coefficients& coefficients, std::span<const Vec3> directions,
                         std::span<const double> base, const Context& context)
    : degree_(coefficients.degree()),
      n_(directions.size()),
      values_((degree_ + std::size_t{1}) * n_) {
  const std::vector<Terms> orders = terms_of(coefficients);
  std::vector<double> sums;
  for (std::size_t first = 0; first < n_; first += kLegendreLanes) {
    report_progress(context, "degrees", static_cast<double>(first) / static_cast<double>(n_));
    const std::size_t count = std::min(kLegendreLanes, n_ - first);
    Waves waves(directions.subspan(first, count));
    const std::size_t width = waves.block.padded;
    sums.assign(orders.size() * width, 0.0);
    for (std::size_t m = 0; m < orders.size(); ++m) {
      if (m > 0) waves.next();
      add_by_degree(orders[m].order, waves.block.cos_theta.data(), waves.block.sin_theta.data(),
                    waves.cosine.data(), waves.sine.data(), width, orders[m].cosine.data(),
                    orders[m].sine.data(), sums.data() + m * width);
    }
    for (std::size_t k = 0; k < count; ++k) {
      double f = -base[first + k];
      for (int l = 0; l <= degree_; ++l) {
        f += sums[l * width + k];
        values_[l * n_ + first + k] = static_cast<float>(f);
      }
    }
  }
}

// Uses summation by parts: sum g_l f_l = sum (g_l - g_l+1) F_l with the truncated sums F_l.
std::vector<float> DegreeTable::filtered(std::span<const double> gains,
                                         std::span<const double> base) const {
  const std::size_t used = std::min(gains.size(), degree_ + std::size_t{1});
  const double first = used > 0 ? gains[0] : 0;
  std::vector<float> values(n_);
  for (std::size_t j = 0; j < n_; ++j) values[j] = static_cast<float>((first - 1) * base[j]);
  for (std::size_t l = 0; l < used; ++l) {
    const auto weight = static_cast<float>(gains[l] - (l + 1 < used ? gains[l + 1] : 0.0));
    if (weight == 0) continue;
    const float* row = &values_[l * n_];
    for (std::size_t j = 0; j < n_; ++j) values[j] += weight * row[j];
  }
  return values;
}

}  // namespace rholm::studio
