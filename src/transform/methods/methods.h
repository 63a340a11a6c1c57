// Direct methods from a star chart to coefficients. Each returns the coefficients of the scaled
// geometry. Two more methods are in paper/methods/paper_methods.h.
#pragma once

#include <cstddef>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/harmonic.h"
#include "transform/geometry/star_geometry.h"
#include "transform/rules/bernstein_rules.h"

namespace rholm {

struct MethodOptions {
  int degree = 0;
  Engine engine = Engine::kDirect;  // for the gauge's sums; other sums are direct
  double allowed = 0;               // l2 norm of the error over 1 <= l <= L
  double mean_allowed = 0;          // error of c_00
};

struct MethodResult {
  Coefficients coefficients;
  std::size_t edge_nodes = 0;
  std::size_t face_nodes = 0;
};

using MethodFunction = MethodResult (*)(const StarGeometry& geometry, const MethodOptions& options,
                                        const Context& context);

MethodResult edge_method(const StarGeometry& geometry, const MethodOptions& options,
                         const Context& context);
MethodResult gauge_method(const StarGeometry& geometry, const MethodOptions& options,
                          const Context& context);

// Returns c_00 of r: (1/sqrt(4 pi)) sum_T d_T int_T dS / |x|^2, within `allowed`.
double radius_mean_coefficient(const StarGeometry& geometry, double allowed);

// Returns the allowance for cubature of r conj(Y) dOmega, undivided by l(l+1), on sources of total
// weight `weight`. An error of E(p; l) <= E(p; L) (l/L)^2 in each Y_lm adds up to sqrt(sum
// (2l+1)/(4 pi) (l/L)^4) <= (L+1) / sqrt(12 pi). Its part at low degrees adds up to sqrt(sum
// (2l+1)/(4 pi)) = (L+1) / sqrt(4 pi).
Allowance undivided_allowance(double allowed, double weight, int degree);

}  // namespace rholm
