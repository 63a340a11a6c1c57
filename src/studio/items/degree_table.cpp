#include "studio/items/degree_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace rholm::studio {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;  // chosen: small against what pages take
constexpr double kMaxWork = 2e9;  // terms; chosen: some two seconds on one processor
// sin^m theta below this is taken for 0: up to degree 1600 what such an order adds to any degree is
// below rounding, as P_lm is of any size only where m < l sin theta, and there sin^m theta is above
// exp(-L / e). Numbers without their full length would be slow.
constexpr double kNothing = 1e-280;
constexpr int kMaxDegreeHere = 1600;
constexpr std::size_t kLanes = 16;  // directions that are worked on together: what vectors hold

// The recurrences of normalised associated Legendre functions, by orders:
// P_lm = a x P_l-1,m - b P_l-2,m.
struct Order {
  std::vector<double> a, b, cosine, sine;  // of l = m ... L
};

std::vector<Order> orders_of(const Coefficients& coefficients) {
  const int degree = coefficients.degree();
  std::vector<Order> orders(degree + std::size_t{1});
  for (int m = 0; m <= degree; ++m) {
    for (int l = m; l <= degree; ++l) {
      const double n = double(l - m) * (l + m);
      const bool first = l == m;
      orders[m].a.push_back(first ? 0 : std::sqrt((2.0 * l - 1) * (2.0 * l + 1) / n));
      orders[m].b.push_back(l < m + 2 ? 0
                                      : std::sqrt((2.0 * l + 1) * (l + m - 1.0) * (l - m - 1.0) /
                                                  (n * (2.0 * l - 3))));
      orders[m].cosine.push_back(coefficients.c(l, m));
      orders[m].sine.push_back(coefficients.s(l, m));
    }
  }
  return orders;
}

// Directions of one block.
struct Block {
  double x[kLanes] = {}, sine[kLanes] = {};  // cos and sin of the colatitude
  double cos_phi[kLanes] = {}, sin_phi[kLanes] = {};
  double sectoral[kLanes];              // P_mm
  double cos_m[kLanes], sin_m[kLanes];  // of m phi
};

Block block_of(std::span<const Vec3> directions) {
  Block block;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Vec3 u = k < directions.size() ? directions[k] : Vec3{0, 0, 1};
    const double s = std::hypot(u.x, u.y);
    block.x[k] = u.z;
    block.sine[k] = s;
    block.cos_phi[k] = s > 0 ? u.x / s : 1;
    block.sin_phi[k] = s > 0 ? u.y / s : 0;
    block.sectoral[k] = 0.5 / std::sqrt(std::numbers::pi);
    block.cos_m[k] = 1;
    block.sin_m[k] = 0;
  }
  return block;
}

// From order m - 1 to m; false if nothing is left.
bool next_order(int m, Block& block) {
  const double factor = m == 1 ? std::sqrt(3.0) : std::sqrt((2.0 * m + 1) / (2.0 * m));
  bool any = false;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double p = factor * block.sine[k] * block.sectoral[k];
    block.sectoral[k] = std::abs(p) < kNothing ? 0 : p;
    any = any || block.sectoral[k] != 0;
    const double c = block.cos_m[k] * block.cos_phi[k] - block.sin_m[k] * block.sin_phi[k];
    block.sin_m[k] = block.sin_m[k] * block.cos_phi[k] + block.cos_m[k] * block.sin_phi[k];
    block.cos_m[k] = c;
  }
  return any;
}

// Adds the terms of one order to the sums of the degrees, [L + 1][kLanes].
void add_order(int m, const Order& order, const Block& block, double* sums) {
  double before[kLanes] = {}, p[kLanes];
  std::copy(block.sectoral, block.sectoral + kLanes, p);
  for (std::size_t i = 0; i < order.a.size(); ++i) {
    double* sum = sums + (m + i) * kLanes;
    const double a = order.a[i], b = order.b[i], c = order.cosine[i], s = order.sine[i];
    for (std::size_t k = 0; k < kLanes; ++k) {
      const double value = i == 0 ? p[k] : a * block.x[k] * p[k] - b * before[k];
      before[k] = i == 0 ? 0 : p[k];
      p[k] = value;
      sum[k] += (c * block.cos_m[k] + s * block.sin_m[k]) * value;
    }
  }
}

}  // namespace

bool DegreeTable::fits(std::size_t directions, int degree) {
  const double n = static_cast<double>(directions), l = degree + 1.0;
  return degree <= kMaxDegreeHere && n * l * sizeof(float) <= static_cast<double>(kMaxBytes) &&
         n * l * l / 2 <= kMaxWork;
}

DegreeTable::DegreeTable(const Coefficients& coefficients, std::span<const Vec3> directions,
                         std::span<const double> base, const Context& context)
    : degree_(coefficients.degree()),
      n_(directions.size()),
      values_((degree_ + std::size_t{1}) * n_) {
  const std::vector<Order> orders = orders_of(coefficients);
  std::vector<double> sums(orders.size() * kLanes);
  for (std::size_t first = 0; first < n_; first += kLanes) {
    report_progress(context, "degrees", static_cast<double>(first) / static_cast<double>(n_));
    const std::size_t count = std::min(kLanes, n_ - first);
    Block block = block_of(directions.subspan(first, count));
    std::fill(sums.begin(), sums.end(), 0.0);
    for (int m = 0; m <= degree_; ++m) {
      if (m > 0 && !next_order(m, block)) break;
      add_order(m, orders[m], block, sums.data());
    }
    for (std::size_t k = 0; k < count; ++k) {
      double f = -base[first + k];
      for (int l = 0; l <= degree_; ++l) {
        f += sums[l * kLanes + k];
        values_[l * n_ + first + k] = static_cast<float>(f);
      }
    }
  }
}

// By parts: sum g_l f_l = sum (g_l - g_l+1) F_l of the cut off F_l.
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
