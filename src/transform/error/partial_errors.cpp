#include "transform/error/partial_errors.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/parallel.h"
#include "harmonic/legendre/legendre_kernels.h"

namespace rholm {
namespace {

// The terms of each degree at a direction.
std::vector<double> terms_of_degrees(const Coefficients& c,
                                     const std::vector<LegendreOrder>& orders, const Vec3& u) {
  std::vector<double> terms(orders.size());
  const double s = std::hypot(u.x, u.y);
  const std::complex<double> turn =
      s > 0 ? std::complex<double>(u.x / s, u.y / s) : std::complex<double>(1, 0);
  std::complex<double> wave = 1;  // e^(i m phi)
  for (const LegendreOrder& order : orders) {
    const int m = order.m;
    const std::vector<double> row = legendre_row(order, u.z, s);
    for (int l = m; l <= c.degree(); ++l) {
      terms[static_cast<std::size_t>(l)] += row[static_cast<std::size_t>(l - m)] *
                                            (c.c(l, m) * wave.real() + c.s(l, m) * wave.imag());
    }
    wave *= turn;
  }
  return terms;
}

}  // namespace

std::vector<double> largest_partial_errors(const ErrorPoints& points, const Coefficients& c,
                                           const Context& context) {
  const std::vector<double> mu = legendre_mu(c.degree());
  std::vector<LegendreOrder> orders;
  orders.reserve(mu.size());
  for (int m = 0; m <= c.degree(); ++m) {
    orders.push_back(legendre_order(m, c.degree(), mu[static_cast<std::size_t>(m)]));
  }
  std::vector<std::vector<double>> errors(points.size());
  parallel_for(points.size(), 1, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      errors[i] = terms_of_degrees(c, orders, points.directions[i]);
      double rest = points.radii[i];
      for (double& value : errors[i]) {
        rest -= value;
        value = std::abs(rest);
      }
    }
  });
  std::vector<double> most(orders.size());
  for (const std::vector<double>& of_point : errors) {
    for (std::size_t l = 0; l < most.size(); ++l) most[l] = std::max(most[l], of_point[l]);
  }
  return most;
}

}  // namespace rholm
