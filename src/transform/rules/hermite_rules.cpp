#include "transform/rules/hermite_rules.h"

#include <algorithm>
#include <cmath>

#include "transform/rules/error_model.h"

namespace rholm {
namespace {

// Beyond this z^2, the derivatives of a rule weigh as much as its values.
constexpr double kFarthestBare = 30, kFarthest = 120;

template <typename Rule, std::size_t kRules>
auto reach_of(const std::array<Rule, kRules>& rules, const std::array<double, kRules>& units,
              double allowed) {
  std::array<double, kRules - 1> reach;
  double before = 0;
  for (std::size_t k = 0; k < reach.size(); ++k) {
    const double farthest = k == 0 ? kFarthestBare : kFarthest;
    before = reach[k] =
        std::max(before, std::min(farthest, std::pow(allowed / units[k], 2.0 / rules[k].power)));
  }
  return reach;
}

}  // namespace

HermiteEdgeReach hermite_edge_reach(double allowed) {
  return reach_of(kHermiteEdges, kHermiteEdgeUnits, allowed);
}
HermiteFaceReach hermite_face_reach(double allowed) {
  return reach_of(kHermiteFaces, kHermiteFaceUnits, allowed);
}

double lumping_error(int degree) {
  return kLumpingConstant * degree_factor({.degree = degree, .allowed = 0, .divided = true}, 4);
}

}  // namespace rholm
