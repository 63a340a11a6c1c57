#include "transform/error/partial_errors.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "base/parallel.h"
#include "harmonic/legendre/legendre_kernels.h"

namespace rholm {
namespace {

// Terms of each degree at one direction.
struct Terms {
  std::vector<double> values;
  std::vector<double> along_theta, along_phi;  // parts of the gradient, on request
};

std::vector<LegendreOrder> orders_of(const Coefficients& c) {
  const std::vector<double> mu = legendre_mu(c.degree());
  std::vector<LegendreOrder> orders;
  orders.reserve(mu.size());
  for (int m = 0; m <= c.degree(); ++m) {
    orders.push_back(legendre_order(m, c.degree(), mu[static_cast<std::size_t>(m)]));
  }
  return orders;
}

// Computes the terms at u, with gradients if u is not a pole. s dP_lm/dtheta = l cos(theta) P_lm -
// f_lm P_(l-1)m with f_lm^2 = (l^2 - m^2) (2l + 1) / (2l - 1).
Terms terms_of_degrees(const Coefficients& c, const std::vector<LegendreOrder>& orders,
                       const Vec3& u, bool slopes) {
  Terms terms;
  terms.values.resize(orders.size());
  if (slopes) terms.along_theta.resize(orders.size());
  if (slopes) terms.along_phi.resize(orders.size());
  const double s = std::hypot(u.x, u.y);
  const std::complex<double> turn =
      s > 0 ? std::complex<double>(u.x / s, u.y / s) : std::complex<double>(1, 0);
  std::complex<double> wave = 1;  // e^(i m phi)
  for (const LegendreOrder& order : orders) {
    const int m = order.m;
    const std::vector<double> row = legendre_row(order, u.z, s);
    for (int l = m; l <= c.degree(); ++l) {
      const auto degree = static_cast<std::size_t>(l);
      const double p = row[static_cast<std::size_t>(l - m)];
      const double along = c.c(l, m) * wave.real() + c.s(l, m) * wave.imag();
      terms.values[degree] += p * along;
      if (!slopes) continue;
      const double before = l > m ? row[static_cast<std::size_t>(l - m - 1)] : 0;
      const double f =
          std::sqrt((1.0 * l * l - 1.0 * m * m) * (2 * l + 1) / std::max(1, 2 * l - 1));
      terms.along_theta[degree] += (l * u.z * p - f * before) / s * along;
      terms.along_phi[degree] += m / s * p * (c.s(l, m) * wave.real() - c.c(l, m) * wave.imag());
    }
    wave *= turn;
  }
  return terms;
}

// Returns for each degree the largest value of error(i) over the points i.
template <typename Error>
std::vector<double> largest_of_points(std::size_t n, int degree, const Context& context,
                                      const Error& error) {
  std::vector<std::vector<double>> errors(n);
  parallel_for(n, 1, context, {}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) errors[i] = error(i);
  });
  std::vector<double> most(static_cast<std::size_t>(degree) + 1);
  for (const std::vector<double>& of_point : errors) {
    for (std::size_t l = 0; l < most.size(); ++l) most[l] = std::max(most[l], of_point[l]);
  }
  return most;
}

}  // namespace

std::vector<double> largest_partial_errors(const ErrorPoints& points, const Coefficients& c,
                                           const Context& context) {
  const std::vector<LegendreOrder> orders = orders_of(c);
  return largest_of_points(points.size(), c.degree(), context, [&](std::size_t i) {
    std::vector<double> errors = terms_of_degrees(c, orders, points.directions[i], false).values;
    double rest = points.radii[i];
    for (double& value : errors) {
      rest -= value;
      value = std::abs(rest);
    }
    return errors;
  });
}

std::vector<double> largest_partial_distances(const ErrorPoints& points, const Coefficients& c,
                                              const Context& context) {
  constexpr double kPole = 1e-6;  // chosen: points that are nearer are left out
  const std::vector<LegendreOrder> orders = orders_of(c);
  return largest_of_points(points.size(), c.degree(), context, [&](std::size_t i) {
    std::vector<double> distances(orders.size());
    const Vec3& u = points.directions[i];
    if (std::hypot(u.x, u.y) < kPole) return distances;
    const Terms terms = terms_of_degrees(c, orders, u, true);
    double r = 0, theta = 0, phi = 0;
    for (std::size_t l = 0; l < distances.size(); ++l) {
      r += terms.values[l];
      theta += terms.along_theta[l];
      phi += terms.along_phi[l];
      const double steep = std::hypot(r, theta, phi);
      distances[l] = steep > 0 ? std::abs((points.radii[i] - r) * r) / steep : 0;
    }
    return distances;
  });
}

}  // namespace rholm
