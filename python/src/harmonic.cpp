// Sums of harmonics at scattered directions, on rings and grids.
#include "rholm/harmonic.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"
#include "rholm/error.h"
#include "rholm/grid.h"

namespace rholm::python {
namespace {

using Matrices = nb::ndarray<const double, nb::shape<-1, 6>, nb::c_contig, nb::device::cpu>;

void bind_sums(nb::module_& m) {
  m.def("evaluate", [](const Coefficients& c, const Rows& directions, const std::string& engine,
                       double precision, const Caller& caller) {
    const SumOptions options{parse_name<Engine>(engine), precision};
    const std::vector<Vec3> at = vector_of(directions);
    return array_of(
        caller.run([&](const Context& context) { return evaluate(c, at, options, context); }));
  });
  m.def("evaluate_with_gradient", [](const Coefficients& c, const Rows& directions,
                                     const std::string& engine, double precision,
                                     const Caller& caller) {
    const SumOptions options{parse_name<Engine>(engine), precision};
    const std::vector<Vec3> at = vector_of(directions);
    ValuesAndGradients sums = caller.run(
        [&](const Context& context) { return evaluate_with_gradient(c, at, options, context); });
    return nb::make_tuple(array_of(std::move(sums.values)), array_of(std::move(sums.gradients)));
  });
  m.def(
      "adjoint",
      [](int degree, const Rows& directions, const std::optional<Doubles>& weights,
         const std::optional<Rows>& gradients, const std::optional<Matrices>& hessians,
         const std::string& engine, double precision, const Caller& caller) {
        const SumOptions options{parse_name<Engine>(engine), precision};
        const std::vector<Vec3> at = vector_of(directions);
        const std::vector<double> w = weights ? vector_of(*weights) : std::vector<double>();
        const std::vector<Vec3> g = gradients ? vector_of(*gradients) : std::vector<Vec3>();
        std::vector<std::array<double, 6>> h;
        if (hessians) {
          const auto* first = reinterpret_cast<const std::array<double, 6>*>(hessians->data());
          h.assign(first, first + hessians->shape(0));
        }
        ScatteredSources sources{.directions = at};
        if (weights) sources.weights = w;
        if (gradients) sources.gradients = g;
        if (hessians) sources.hessians = h;
        Coefficients sum(degree);
        caller.run([&](const Context& context) { add_adjoint(sources, sum, options, context); });
        return sum;
      },
      nb::arg(), nb::arg(), nb::arg().none(), nb::arg().none(), nb::arg().none(), nb::arg(),
      nb::arg(), nb::arg());
  m.def("gauss_legendre", [](int n) {
    GaussRule rule = unlocked([&] { return gauss_legendre(n); });
    return nb::make_tuple(array_of(std::move(rule.nodes)), array_of(std::move(rule.weights)));
  });
}

GridKind parse_grid_kind(const std::string& name) {
  if (name == "gauss-legendre") return GridKind::kGaussLegendre;
  if (name == "equiangular") return GridKind::kEquiangular;
  if (name == "equiangular-with-poles") return GridKind::kEquiangularWithPoles;
  throw Error(ErrorCode::kInvalidInput, "no grid is called '" + name +
                                            "'; there are gauss-legendre, equiangular and "
                                            "equiangular-with-poles");
}

void bind_grids(nb::module_& m) {
  m.def("exact_degree", [](const std::string& kind, int n_theta, int n_phi) {
    return exact_degree({parse_grid_kind(kind), n_theta, n_phi});
  });
  m.def("smallest_grid", [](const std::string& kind, int degree) {
    const Grid grid = smallest_grid(parse_grid_kind(kind), degree);
    return nb::make_tuple(grid.n_theta, grid.n_phi);
  });
  m.def("grid_colatitudes", [](const std::string& kind, int n_theta) {
    return array_of(grid_colatitudes({parse_grid_kind(kind), n_theta, 1}));
  });
  m.def("synthesize_grid", [](const Coefficients& c, const std::string& kind, int n_theta,
                              int n_phi, const Caller& caller) {
    const Grid grid{parse_grid_kind(kind), n_theta, n_phi};
    return array_of(
        caller.run([&](const Context& context) { return synthesize_grid(c, grid, context); }));
  });
  m.def("analyze_grid", [](const Doubles& values, const std::string& kind, int n_theta, int n_phi,
                           int degree, const Caller& caller) {
    const Grid grid{parse_grid_kind(kind), n_theta, n_phi};
    const std::vector<double> own = vector_of(values);
    return caller.run(
        [&](const Context& context) { return analyze_grid(own, grid, degree, context); });
  });
  m.def("evaluate_rings",
        [](const Coefficients& c, const Doubles& colatitudes, int n_phi, const Caller& caller) {
          const std::vector<double> rings = vector_of(colatitudes);
          return array_of(caller.run(
              [&](const Context& context) { return evaluate_rings(c, rings, n_phi, context); }));
        });
}

}  // namespace

void bind_harmonic(nb::module_& m) {
  bind_sums(m);
  bind_grids(m);
}

}  // namespace rholm::python
