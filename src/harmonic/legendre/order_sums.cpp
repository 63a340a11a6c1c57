#include "harmonic/legendre/order_sums.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "harmonic/legendre/legendre_kernels.h"

namespace rholm {
namespace {

constexpr std::size_t kOrdersPerTask = 4;  // chosen: tasks of about 1 ms at L = 256

std::size_t pad(std::size_t n) {
  return (n + kLegendreLanes - 1) / kLegendreLanes * kLegendreLanes;
}

}  // namespace

DirectionBlock::DirectionBlock(std::size_t n)
    : size(n),
      padded(pad(n)),
      cos_theta(padded, 0.0),
      sin_theta(padded, 1.0),
      cos_phi(padded, 1.0),
      sin_phi(padded, 0.0) {}

DirectionBlock::DirectionBlock(std::span<const Vec3> directions)
    : DirectionBlock(directions.size()) {
  for (std::size_t j = 0; j < size; ++j) {
    const Vec3& u = directions[j];
    const double s = std::hypot(u.x, u.y);
    cos_theta[j] = u.z;
    sin_theta[j] = s;
    if (s > 0) {
      cos_phi[j] = u.x / s;
      sin_phi[j] = u.y / s;
    }
  }
}

DirectionBlock::DirectionBlock(std::span<const double> colatitudes)
    : DirectionBlock(colatitudes.size()) {
  for (std::size_t j = 0; j < size; ++j) {
    cos_theta[j] = std::cos(colatitudes[j]);
    sin_theta[j] = std::sin(colatitudes[j]);
  }
}

void OrderTable::reset(int degree, const DirectionBlock& block) {
  padded = block.padded;
  re.resize((degree + std::size_t{1}) * padded);
  im.resize(re.size());
  for (int m = 0; m <= degree; ++m) {
    std::fill(re_row(m) + block.size, re_row(m) + padded, 0.0);
    std::fill(im_row(m) + block.size, im_row(m) + padded, 0.0);
  }
}

std::size_t chunk_size(int degree) {
  const std::size_t bytes_per_direction = sizeof(double) * (degree + std::size_t{1});
  return std::clamp<std::size_t>(pad((4u << 20) / bytes_per_direction), 256, 16384);
}

void add_order_sums(const DirectionBlock& block, const OrderTable& table, Coefficients& sum,
                    const Context& context, const ParallelStage& stage) {
  const int degree = sum.degree();
  const std::vector<double> mu = legendre_mu(degree);
  const std::size_t orders = degree + std::size_t{1};
  parallel_for(orders, kOrdersPerTask, context, stage, [&](std::size_t begin, std::size_t end) {
    std::vector<double> c(orders), s(orders);
    for (std::size_t i = begin; i < end; ++i) {
      const int m = static_cast<int>(i);
      const LegendreOrder order = legendre_order(m, degree, mu[i]);
      std::fill(c.begin(), c.end(), 0.0);
      std::fill(s.begin(), s.end(), 0.0);
      legendre_adjoint(order, block.cos_theta.data(), block.sin_theta.data(), block.padded,
                       table.re_row(m), table.im_row(m), c.data(), s.data());
      for (int l = m; l <= degree; ++l) {
        sum.c(l, m) += c[l - m];
        if (m > 0) sum.s(l, m) += s[l - m];
      }
    }
  });
}

void evaluate_orders(const DirectionBlock& block, std::span<const Coefficients> sets,
                     std::span<OrderTable> tables, const Context& context,
                     const ParallelStage& stage) {
  const int degree = sets.front().degree();
  const std::vector<double> mu = legendre_mu(degree);
  const std::size_t orders = degree + std::size_t{1};
  parallel_for(orders, kOrdersPerTask, context, stage, [&](std::size_t begin, std::size_t end) {
    std::array<std::vector<double>, 4> c, s;
    std::array<const double*, 4> c_row{}, s_row{};
    std::array<double*, 4> re_row{}, im_row{};
    for (std::size_t i = begin; i < end; ++i) {
      const int m = static_cast<int>(i);
      const LegendreOrder order = legendre_order(m, degree, mu[i]);
      for (std::size_t set = 0; set < sets.size(); ++set) {
        c[set].clear();
        s[set].clear();
        for (int l = m; l <= degree; ++l) {
          c[set].push_back(sets[set].c(l, m));
          s[set].push_back(sets[set].s(l, m));
        }
        c_row[set] = c[set].data();
        s_row[set] = s[set].data();
        re_row[set] = tables[set].re_row(m);
        im_row[set] = tables[set].im_row(m);
      }
      legendre_forward(order, block.cos_theta.data(), block.sin_theta.data(), block.padded,
                       static_cast<int>(sets.size()), c_row.data(), s_row.data(), re_row.data(),
                       im_row.data());
    }
  });
}

}  // namespace rholm
