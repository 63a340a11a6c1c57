// Sums of spherical harmonics at scattered directions, and their transpose. Layer: harmonic.
//
// Directions are unit vectors; lengths are not checked, a deviation of eps changes the results
// by L eps. All sums are direct, O(N L^2), vectorised, and stable at every colatitude to degree
// kMaxDegree. Results are the same bits for every number of threads.
#pragma once

#include <span>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/vec3.h"

namespace rholm {

// f(u_j) for every direction.
std::vector<double> evaluate(const Coefficients& coefficients, std::span<const Vec3> directions,
                             const Context& context = {});

struct ValuesAndGradients {
  std::vector<double> values;
  std::vector<Vec3> gradients;  // surface gradient on the unit sphere, tangential at u_j
};
ValuesAndGradients evaluate_with_gradient(const Coefficients& coefficients,
                                          std::span<const Vec3> directions,
                                          const Context& context = {});

// The transpose of evaluate(): C_lm = sum_j w_j Y^c_lm(u_j), S_lm likewise. weights.size() ==
// directions.size(). Added to `sum`, whose degree says up to which L.
void add_adjoint(std::span<const Vec3> directions, std::span<const double> weights,
                 Coefficients& sum, const Context& context = {});

// The transpose of the gradient: C_lm = sum_j g_j . grad_S Y^c_lm(u_j). Each g_j must be
// tangential, g_j . u_j = 0.
void add_adjoint_gradient(std::span<const Vec3> directions, std::span<const Vec3> vectors,
                          Coefficients& sum, const Context& context = {});

// Values on rings: f(theta_i, phi_k), phi_k = 2 pi k / n_phi, row-major [thetas][n_phi].
// O(L^2) per ring.
std::vector<double> evaluate_rings(const Coefficients& coefficients,
                                   std::span<const double> colatitudes, int n_phi,
                                   const Context& context = {});

// Gauss-Legendre nodes (descending cos theta) and weights on [-1, 1], n >= 1.
struct GaussRule {
  std::vector<double> nodes;
  std::vector<double> weights;
};
GaussRule gauss_legendre(int n);

}  // namespace rholm
