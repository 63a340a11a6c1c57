#include "transform/mesh_pass/plan/error_budget.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rholm {

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
  const double lumped2 =
      plan.coherence > 0 ? plan.coherence * facts.face_error2 : facts.face_error2 + edges2;
  const double rules = rule_error(plan, lumped2, static_cast<double>(facts.noded));
  const GridLayout& layout = facts.transform.fourier.layout;
  const double relative_window =
      spread_error(layout.width, static_cast<double>(layout.n_phi) / (2.0 * std::max(degree, 1)));
  const double rounding = plan.single ? single_rounding(degree, plan.block.hessians ? 2 : 1) : 0.0;
  const auto generic = [](double square) { return std::sqrt(square / (4 * std::numbers::pi)); };
  const double amplified =
      std::pow(hessian_factor(facts.transform, facts.vertices), 2) * facts.hessian2;
  const double window = relative_window * generic(facts.source2 + amplified) +
                        rounding * generic(facts.source2 + facts.hessian2);
  const double scale = plan.block.scale;
  // Vertices in step with the grid leave the window's error of the whole, see
  // MeshPlan::most_window.
  const double in_step = 0.5 * relative_window * scale * norm_of_degrees(coefficients, 1, degree);
  PassError error;
  error.whole = std::hypot(rules, window, std::hypot(in_step, plan.quanta)) / scale;
  // Of l^6, as the error of lumping grows, 0.82 lies above 3L/4; of (2l+1)/(l(l+1))^2, as that of
  // windows falls, 0.78 / L^2.
  error.band = std::hypot(0.9 * rules, 0.88 / std::max(degree, 1) * window) / scale;
  if (facts.face_error2 > 0) error.edge_ratio = edges2 / facts.face_error2;
  return error;
}

}  // namespace rholm
