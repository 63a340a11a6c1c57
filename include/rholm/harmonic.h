// Sums of spherical harmonics at scattered directions, and their transpose. Layer: harmonic.
//
// Directions are unit vectors; lengths are not checked, a deviation of eps changes the results
// by L eps. Results are the same bits for every number of threads.
//
// The fast engine works on an oversampled grid of colatitude and longitude: O(N + L^3), with an
// error that is chosen. Where direct sums, O(N L^2), are cheaper (few directions, low degree) it
// takes those. Direct sums are exact to rounding at every colatitude, to degree kMaxDegree.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "rholm/coefficients.h"
#include "rholm/context.h"
#include "rholm/fields.h"
#include "rholm/vec3.h"

namespace rholm {

// How sums over directions are done.
enum class Engine {
  kFast,   // on a grid, to a wanted precision
  kDirect  // term by term: the oracle
};
EnumNames names_of(Engine engine);  // "fast", "direct"

// How sums are done, and how exactly.
struct SumOptions {
  Engine engine = Engine::kFast;  // kDirect does not look at the precision
  // Of the fast engine, 1e-14 ... 1e-1. The l2 norm of the error of all values (coefficients) is at
  // most about this part of that of sums with random signs: sqrt(n_values sum C^2 / 4 pi) for
  // evaluate(), sqrt((L+1)^2 sum w^2 / 4 pi) for add_adjoint(). Gradients relative to
  // L times as much, Hessians to L^2 times.
  double precision = 1e-12;
};

// Their list (fields.h).
template <typename Visitor>
void visit_fields(FieldsOf<SumOptions>, const Visitor& field) {
  using O = SumOptions;
  field(&O::engine, {.name = "engine",
                     .help = "how sums are done: fast, to the precision; direct, term by term"});
  field(&O::precision, {.name = "precision",
                        .help = "of the fast engine, relative to sums with random signs",
                        .value = "E",
                        .least = 1e-14,
                        .most = 0.1});
}

// f(u_j) for every direction.
std::vector<double> evaluate(const Coefficients& coefficients, std::span<const Vec3> directions,
                             const SumOptions& options = {}, const Context& context = {});

// For every direction u_j.
struct ValuesAndGradients {
  std::vector<double> values;   // f(u_j)
  std::vector<Vec3> gradients;  // surface gradient on the unit sphere, tangential at u_j
};
// The same with the gradients.
ValuesAndGradients evaluate_with_gradient(const Coefficients& coefficients,
                                          std::span<const Vec3> directions,
                                          const SumOptions& options = {},
                                          const Context& context = {});

// Weights of the values, gradients and Hessians of Y(x/|x|) at x = u_j: each empty, or as long as
// `directions`.
struct ScatteredSources {
  std::span<const Vec3> directions;      // u_j, unit vectors
  std::span<const double> weights = {};  // w_j
  std::span<const Vec3> gradients = {};  // g_j, contracted with the gradient in space
  // h_j, symmetric matrices xx, xy, xz, yy, yz, zz.
  std::span<const std::array<double, 6>> hessians = {};
};

// C_lm += sum_j (w_j + g_j . grad + h_j : Hess) Y^c_lm (u_j), S_lm likewise, up to the degree of
// `sum`. With weights alone the transpose of evaluate(), with gradients alone that of the gradient.
// Throws InvalidInput for spans of other lengths.
void add_adjoint(const ScatteredSources& sources, Coefficients& sum, const SumOptions& options = {},
                 const Context& context = {});

// Values on rings: f(theta_i, phi_k), phi_k = 2 pi k / n_phi, row-major [thetas][n_phi].
// O(L^2) per ring.
std::vector<double> evaluate_rings(const Coefficients& coefficients,
                                   std::span<const double> colatitudes, int n_phi,
                                   const Context& context = {});

// A rule for integrals over [-1, 1].
struct GaussRule {
  std::vector<double> nodes;    // descending: cosines of colatitudes from north to south
  std::vector<double> weights;  // one per node, their sum is 2
};
// Gauss-Legendre's with n >= 1 nodes, exact for polynomials of degree 2 n - 1.
GaussRule gauss_legendre(int n);

}  // namespace rholm
