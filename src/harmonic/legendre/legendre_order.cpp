#include "harmonic/legendre/legendre_order.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace rholm {

LegendreOrder legendre_order(int m, int degree, double mu) {
  LegendreOrder order{
      .m = m, .degree = degree, .mu = mu, .rho = {}, .of_difference = {}, .of_value = {}};
  for (int l = m; l < degree; ++l) {
    const double ll = l, mm = m;
    const double rho = std::sqrt((2 * ll + 3) * (ll + 1 + mm) / ((2 * ll + 1) * (ll + 1 - mm)));
    order.rho.push_back(rho);
    order.of_difference.push_back(rho * (ll - mm) / (ll + mm + 1));
    order.of_value.push_back(rho * (2 * ll + 1) / (ll + mm + 1));
  }
  return order;
}

std::vector<double> legendre_mu(int degree) {
  std::vector<double> mu(degree + std::size_t{1});
  double square = 1 / (4 * std::numbers::pi);
  mu[0] = std::sqrt(square);
  for (int m = 1; m <= degree; ++m) {
    square *= (2.0 * m + 1) / (2.0 * m);
    mu[m] = std::sqrt(2 * square);
  }
  return mu;
}

}  // namespace rholm
