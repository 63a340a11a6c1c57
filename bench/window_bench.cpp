// Window errors of sums over scattered directions, compared with direct sums: random weights and
// even directions. Errors are l2 norms over all coefficients, relative to the norm of a random sum.
// The table has ratios to window_error(), for values, and for gradients and Hessians that count as
// much as weights (gradient_factor(), hessian_factor(), gradient_as_weight()). At the end come
// ratios to 1 (single_rounding()) in single precision, with windows of smaller error. They test all
// statements of src/harmonic/nonuniform/window_error.h.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.h"
#include "harmonic/legendre/direct_sums.h"
#include "harmonic/nonuniform/nonuniform.h"
#include "harmonic/nonuniform/window_error.h"
#include "mesh_sources.h"

namespace rholm {
namespace {

struct Sources {
  std::vector<Vec3> directions;
  std::vector<double> weights;
  std::vector<Vec3> gradients;
  std::vector<std::array<double, 6>> hessians;

  ScatteredSources of(int derivatives) const {
    ScatteredSources sources{.directions = directions};
    if (derivatives == 0) sources.weights = weights;
    if (derivatives == 1) sources.gradients = gradients;
    if (derivatives == 2) sources.hessians = hessians;
    return sources;
  }
};

double sign(std::uint64_t stream, std::size_t j) {
  return random_uniform(stream, j) < 0.5 ? -1 : 1;
}

// Derivatives along the sphere have the size of a weight 1: L |g| = 1, L^2 |h| = 1.
Sources random_sources(std::size_t n, int degree) {
  Sources sources;
  const double l = std::max(degree, 1);
  for (std::size_t j = 0; j < n; ++j) {
    const double z = 2 * random_uniform(1, j) - 1;
    const double phi = 2 * std::numbers::pi * random_uniform(2, j);
    const double s = std::sqrt(1 - z * z);
    sources.directions.push_back({s * std::cos(phi), s * std::sin(phi), z});
    sources.weights.push_back(sign(3, j));
    const Vec3 east{-std::sin(phi), std::cos(phi), 0}, north = cross(sources.directions[j], east);
    const double turn = 2 * std::numbers::pi * random_uniform(4, j);
    const Vec3 g = std::cos(turn) * east + std::sin(turn) * north;
    sources.gradients.push_back(sign(5, j) / l * g);
    const double h = sign(6, j) / (l * l);
    sources.hessians.push_back(
        {h * g.x * g.x, h * g.x * g.y, h * g.x * g.z, h * g.y * g.y, h * g.y * g.z, h * g.z * g.z});
  }
  return sources;
}

double l2(const Coefficients& c) {
  double sum = 0;
  for (const double value : c.values()) sum += value * value;
  return std::sqrt(sum);
}

class Judge {
 public:
  Judge(std::size_t n, int degree) : degree_(degree), sources_(random_sources(n, degree)) {
    for (int d = 0; d < 3; ++d) {
      exact_.emplace_back(degree);
      direct_add_adjoint(sources_.of(d), exact_.back(), {});
    }
  }

  // Returns the l2 norm of the window error, relative to the sum of values.
  double error(int derivatives, int width, double sigma, bool single) const {
    NonuniformPlan plan = plan_nonuniform({.degree = degree_,
                                           .allowed = single ? 1e-4 : 1e-6,
                                           .sources = sources_.directions.size(),
                                           .derivatives = derivatives,
                                           .forbid_single = !single});
    if (plan.single != single) return NAN;
    plan.fourier = fourier_of<double>(width, degree_, sigma);
    Coefficients found(degree_);
    nonuniform_add_adjoint(plan, sources_.of(derivatives), derivatives, found, {});
    const Coefficients& exact = exact_[static_cast<std::size_t>(derivatives)];
    for (std::size_t i = 0; i < found.values().size(); ++i) found.values()[i] -= exact.values()[i];
    return l2(found) / l2(exact_[0]);
  }
  double sigma_of(double wished) const {
    return static_cast<double>(fourier_of<double>(4, degree_, wished).layout.n_phi) /
           (2.0 * degree_);
  }

 private:
  int degree_;
  Sources sources_;
  std::vector<Coefficients> exact_;
};

void doubles() {
  std::printf(
      "| L | sigma | width | window_error | values | gradients | Hessians |\n"
      "|---|---|---|---|---|---|---|\n");
  for (const int degree : {32, 128}) {
    const Judge judge(3000, degree);
    for (const double wished : {1.25, 1.5, 2.0, 2.8}) {
      const double sigma = judge.sigma_of(wished);
      for (const int width : {3, 5, 8, 11, 14}) {
        const double unit = window_error(width, sigma);
        if (unit < 1e-12) continue;
        std::printf("| %d | %.2f | %d | %.1e |", degree, sigma, width, unit);
        for (int d = 0; d < 3; ++d) {
          std::printf(" %.2f |", judge.error(d, width, wished, false) / unit);
        }
        std::printf("\n");
      }
    }
  }
}

void singles() {
  std::printf(
      "\n| L | width | values | gradients | Hessians | single_rounding |\n"
      "|---|---|---|---|---|---|\n");
  for (const int degree : {16, 64, 256}) {
    const Judge judge(3000, degree);
    constexpr int kWidth = 10;  // the widest window in single precision
    std::printf("| %d | %d |", degree, kWidth);
    for (int d = 0; d < 3; ++d) std::printf(" %.1e |", judge.error(d, kWidth, 2.5, true));
    std::printf(" %.1e, %.1e |\n", single_rounding(degree), single_rounding(degree, 2));
  }
}

}  // namespace
}  // namespace rholm

int main() {
  rholm::doubles();
  rholm::singles();
  return 0;
}
