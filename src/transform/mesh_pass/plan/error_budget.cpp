#include "transform/mesh_pass/plan/error_budget.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "harmonic/nonuniform/window_error.h"
#include "transform/rules/hermite_rules.h"

namespace rholm {

double sampled_error2(std::vector<SampledHalfEdge>& sample, std::uint32_t sampled_names) {
  std::sort(sample.begin(), sample.end(), [](const SampledHalfEdge& a, const SampledHalfEdge& b) {
    return a.name != b.name ? a.name < b.name : a.error < b.error;
  });
  double sum = 0;
  for (std::size_t i = 0; i < sample.size();) {
    double error = 0;
    const std::uint64_t name = sample[i].name;
    for (; i < sample.size() && sample[i].name == name; ++i) {
      if (sample[i].lumped) error += sample[i].error;
    }
    sum += error * error;
  }
  return sum * 4294967296.0 / std::max(1.0, static_cast<double>(sampled_names));
}

double norm_of_degrees(const Coefficients& c, int first, int last) {
  double sum = 0;
  for (int l = first; l <= last; ++l) {
    for (int m = 0; m <= l; ++m) sum += c.c(l, m) * c.c(l, m) + c.s(l, m) * c.s(l, m);
  }
  return std::sqrt(sum);
}

PassError error_of_pass(const MeshPlan& plan, PassFacts& facts, const Coefficients& coefficients) {
  const int degree = plan.divided.degree;
  const double edges2 = sampled_error2(facts.half_edges, plan.block.sampled_names);
  const double lumps = lumping_error(degree) * plan.neighbours;
  const double rules = plan.allowed.caution *
                       std::sqrt(lumps * lumps * (facts.face_error2 + edges2) + facts.node_error2);
  const GridLayout& layout = facts.transform.fourier.layout;
  const double sigma = static_cast<double>(layout.n_phi) / (2.0 * std::max(degree, 1));
  const double relative_window = window_error(layout.width, sigma);
  const double rounding = plan.single ? single_rounding(degree, plan.block.hessians ? 2 : 1) : 0.0;
  const auto generic = [](double square) { return std::sqrt(square / (4 * std::numbers::pi)); };
  const double amplified =
      std::pow(hessian_factor(sigma, degree, facts.vertices), 2) * facts.hessian2;
  const double counted = std::pow(counted_gradient_factor(sigma), 2) * facts.source2;
  const double window = relative_window * generic(counted + amplified) +
                        rounding * generic(facts.source2 + facts.hessian2);
  const double scale = plan.block.scale;
  // Vertices aligned with the grid have a window error in proportion to the error of the whole, see
  // AllowedErrors::most_window. Values have half of it (measured as kLatticeShare of plan.cpp).
  // Hessians have all of it, times the root of their ratio to the sum of squares.
  const double whole = relative_window * scale * norm_of_degrees(coefficients, 1, degree);
  const double lattice =
      whole * std::hypot(0.5, std::sqrt(amplified / std::max(facts.source2, 1e-300)));
  const double rows = rows_in_step(plan, facts.node_modulus) * relative_window;
  PassError error;
  const double beside = std::hypot(window, std::hypot(lattice, rows, plan.quanta_error));
  error.whole = std::hypot(rules, beside) / scale;
  error.whole_beside = beside / scale;
  // The degrees above 3L/4 have 0.82 of l^6, which the lumping error follows. They have 0.78 / L^2
  // of (2l+1)/(l(l+1))^2, which the window error follows.
  error.band_beside = 0.88 / std::max(degree, 1) * window / scale;
  error.band = std::hypot(0.9 * rules / scale, error.band_beside);
  return error;
}

}  // namespace rholm
