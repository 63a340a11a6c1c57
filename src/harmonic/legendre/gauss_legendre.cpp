// Gauss-Legendre nodes by Newton's method on P_n from Tricomi's asymptotic guess. The weights
// 2 / ((1 - x^2) P_n'(x)^2) are stationary in x: an error of the node hardly changes them.
#include <cmath>
#include <numbers>
#include <string>

#include "rholm/error.h"
#include "rholm/harmonic.h"

namespace rholm {
namespace {

struct ValueAndSlope {
  double value, slope;
};

// Returns P_n and P_n' at x in (-1, 1).
ValueAndSlope legendre_polynomial(int n, double x) {
  double p0 = 1, p1 = x;
  for (int k = 2; k <= n; ++k) {
    const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
    p0 = p1;
    p1 = p2;
  }
  return {p1, n * (p0 - x * p1) / (1 - x * x)};
}

}  // namespace

GaussRule gauss_legendre(int n) {
  if (n < 1) {
    throw Error(ErrorCode::kInvalidInput,
                "a Gauss rule needs at least 1 node, not " + std::to_string(n));
  }
  GaussRule rule{std::vector<double>(n), std::vector<double>(n)};
  for (int i = 0; i < (n + 1) / 2; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    if (2 * i + 1 == n) x = 0;
    // The guess is good to O(n^-2): three steps reach rounding precision; one is a reserve.
    for (int step = 0; step < 4; ++step) {
      const ValueAndSlope p = legendre_polynomial(n, x);
      if (2 * i + 1 != n) x -= p.value / p.slope;
    }
    const double slope = legendre_polynomial(n, x).slope;
    rule.nodes[i] = x;
    rule.nodes[n - 1 - i] = -x;
    rule.weights[i] = rule.weights[n - 1 - i] = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace rholm
