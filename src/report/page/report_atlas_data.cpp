#include <cmath>
#include <numbers>

#include "report/page/report_atlas.h"

namespace rholm::report {
namespace {

// Calls f(degree, coefficient) for each coefficient of a cap.
template <typename Function>
void for_each_coefficient(const Atlas& atlas, const Cap& cap, const Function& f) {
  const auto coefficients = atlas.coefficients_of(cap);
  std::size_t k = 0;
  for (int l = 0; l <= cap.degree; ++l) {
    for (const std::size_t end = n_coefficients(cap.basis, l); k < end; ++k) f(l, coefficients[k]);
  }
}

}  // namespace

std::vector<int> drawn_limits(const Atlas& atlas) {
  const int degree = highest_degree(atlas);
  std::vector<int> limits;
  for (const int part : {4, 2, 1}) {
    const int limit = degree / part;
    if (part == 1 || (limit > 0 && (limits.empty() || limit > limits.back()))) {
      limits.push_back(limit);
    }
  }
  return limits;
}

std::size_t coefficients_up_to(const Atlas& atlas, int degree) {
  std::size_t n = 0;
  for (const Cap& cap : atlas.caps) {
    for_each_coefficient(atlas, cap, [&](int l, double c) { n += l <= degree && c != 0; });
  }
  return n;
}

std::vector<double> cap_heights_by_degree(const Atlas& atlas) {
  std::vector<double> squares(static_cast<std::size_t>(highest_degree(atlas)) + 1, 0.0);
  double sizes = 0;
  for (const Cap& cap : atlas.caps) {
    const double size = cap.frame.support * cap.frame.support;
    const double share = size * cap.frame.radius * cap.frame.radius;
    for_each_coefficient(atlas, cap, [&](int l, double c) {
      squares[static_cast<std::size_t>(l)] += share * c * c;
    });
    sizes += size;
  }
  // The mean over a sphere of the square of an orthonormal function is 1 / (4 pi).
  for (double& square : squares) {
    square = sizes > 0 ? std::sqrt(square / (4 * std::numbers::pi * sizes)) : 0;
  }
  return squares;
}

}  // namespace rholm::report
