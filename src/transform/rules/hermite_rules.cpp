#include "transform/rules/hermite_rules.h"

#include <algorithm>
#include <cmath>

#include "transform/rules/error_model.h"

namespace rholm {
namespace {

// Beyond z^2 of this, the derivatives of a rule weigh as much as its values.
constexpr HermiteReach kFarthest = {30, 120};

template <typename Rules, typename Units>
HermiteReach reach_of(const Rules& rules, const Units& units, double allowed) {
  HermiteReach reach;
  for (std::size_t k = 0; k < reach.size(); ++k) {
    reach[k] = std::min(kFarthest[k], std::pow(allowed / units[k], 2.0 / rules[k].power));
  }
  reach[1] = std::max(reach[0], reach[1]);
  return reach;
}

}  // namespace

HermiteReach hermite_edge_reach(double allowed) {
  return reach_of(kHermiteEdges, kHermiteEdgeUnits, allowed);
}
HermiteReach hermite_face_reach(double allowed) {
  return reach_of(kHermiteFaces, kHermiteFaceUnits, allowed);
}

double lumping_error(int degree) {
  return kLumpingConstant * degree_factor({.degree = degree, .allowed = 0, .divided = true}, 4);
}

}  // namespace rholm
