// Sums of spherical harmonics at scattered directions, and the transpose. Layer: harmonic.
//
// Directions are unit vectors. Lengths are not checked: a deviation of eps changes the results by L
// eps. Results are the same bits for every number of threads.
//
// The fast engine uses an oversampled grid of colatitude and longitude: O(N + L^3), with a chosen
// error. It computes direct sums, O(N L^2), where they are cheaper (small N, low degree). Direct
// sums are exact to rounding at every colatitude, up to degree kMaxDegree.
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

// Ways to compute sums over directions.
enum class Engine {
  kFast,   // on a grid, to a wanted precision
  kDirect  // term by term: the reference
};
EnumNames names_of(Engine engine);  // "fast", "direct"

// Engine and precision of sums.
struct SumOptions {
  Engine engine = Engine::kFast;  // kDirect ignores the precision
  // Precision of the fast engine, 1e-14 ... 1e-1: l2 error of all values (coefficients), relative
  // to the l2 norm of sums with random signs. This norm is sqrt(n_values sum C^2 / 4 pi) for
  // evaluate() and sqrt((L+1)^2 sum w^2 / 4 pi) for add_adjoint(). It is multiplied by L for
  // gradients, by L^2 for Hessians. The precision is kept approximately.
  double precision = 1e-12;
};

// Lists the fields of SumOptions (fields.h).
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

// Returns f(u_j) for every direction.
std::vector<double> evaluate(const Coefficients& coefficients, std::span<const Vec3> directions,
                             const SumOptions& options = {}, const Context& context = {});

// Values and gradients for every direction u_j.
struct ValuesAndGradients {
  std::vector<double> values;   // f(u_j)
  std::vector<Vec3> gradients;  // surface gradient on the unit sphere, tangential at u_j
};
// Returns values and gradients for every direction.
ValuesAndGradients evaluate_with_gradient(const Coefficients& coefficients,
                                          std::span<const Vec3> directions,
                                          const SumOptions& options = {},
                                          const Context& context = {});

// Weights of the values, gradients and Hessians of Y(x/|x|) at x = u_j. Each span is empty or as
// long as `directions`.
struct ScatteredSources {
  std::span<const Vec3> directions;      // u_j, unit vectors
  std::span<const double> weights = {};  // w_j
  std::span<const Vec3> gradients = {};  // g_j, contracted with the spatial gradient
  // h_j, symmetric matrices xx, xy, xz, yy, yz, zz.
  std::span<const std::array<double, 6>> hessians = {};
};

// Adds sum_j (w_j + g_j . grad + h_j : Hess) Y^c_lm (u_j) to C_lm, and the same with Y^s_lm to
// S_lm, up to the degree of `sum`. It is the transpose of evaluate() for weights alone, of the
// gradient for gradients alone. Throws InvalidInput for spans of other lengths.
void add_adjoint(const ScatteredSources& sources, Coefficients& sum, const SumOptions& options = {},
                 const Context& context = {});

// Returns values on rings: f(theta_i, phi_k), phi_k = 2 pi k / n_phi, row-major [thetas][n_phi].
// Takes O(L^2) per ring.
std::vector<double> evaluate_rings(const Coefficients& coefficients,
                                   std::span<const double> colatitudes, int n_phi,
                                   const Context& context = {});

// Quadrature rule on [-1, 1].
struct GaussRule {
  std::vector<double> nodes;    // descending: cosines of colatitudes from north to south
  std::vector<double> weights;  // one per node, their sum is 2
};
// Returns Gauss-Legendre's rule with n >= 1 nodes, exact for polynomials of degree 2 n - 1.
GaussRule gauss_legendre(int n);

}  // namespace rholm
