// From a mesh to an expansion: encoding, its steps, errors, random points.
#include "rholm/transform.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"
#include "rholm/error.h"
#include "rholm/model.h"
#include "rholm/monte_carlo.h"
#include "rholm/rms_beyond.h"
#include "rholm/star.h"
#include "rholm/truncation.h"

namespace rholm::python {
namespace {

// Rows of float32 or float64 at any stride, and rows of 32-bit indices at any stride.
using AnyVertices = nb::ndarray<nb::ro, nb::shape<-1, 3>, nb::device::cpu>;
using AnyTriangles = nb::ndarray<nb::ro, std::uint32_t, nb::shape<-1, 3>, nb::device::cpu>;

// Returns a view of arrays. The Python code ensures that numbers of a row are side by side and that
// nobody can write to the arrays.
MeshView view_of_arrays(const AnyVertices& vertices, const AnyTriangles& triangles) {
  const bool single = vertices.dtype() == nb::dtype<float>();
  if (!single && vertices.dtype() != nb::dtype<double>()) {
    throw nb::type_error("vertices are float32 or float64");
  }
  const auto stride_of = [](const auto& rows, std::size_t item) {
    if (rows.shape(0) > 0 && (rows.stride(1) != 1 || rows.stride(0) < 0)) {
      throw nb::type_error("the numbers of a row do not lie side by side");
    }
    return static_cast<std::size_t>(rows.stride(0)) * item;
  };
  return {.vertices = static_cast<const std::byte*>(vertices.data()),
          .n_vertices = vertices.shape(0),
          .vertex_stride = stride_of(vertices, single ? sizeof(float) : sizeof(double)),
          .coordinate = single ? ScalarType::kFloat32 : ScalarType::kFloat64,
          .faces = reinterpret_cast<const std::byte*>(triangles.data()),
          .n_faces = triangles.shape(0),
          .face_stride = stride_of(triangles, sizeof(std::uint32_t))};
}

void bind_star(nb::module_& m) {
  Record<StarReport>(m, "StarReport", "Visibility of a mesh from a centre.").fields();
  m.def("find_center", [](const Mesh& mesh, const CenterOptions& options, const Caller& caller) {
    return caller.run([&](const Context& context) { return find_center(mesh, options, context); });
  });
  m.def("check_star", [](const Mesh& mesh, const Vec3& center, int rays, const Caller& caller) {
    return caller.run(
        [&](const Context& context) { return check_star(mesh, center, rays, context); });
  });
  nb::class_<StarChart> chart_class(m, "StarChart", "A mesh relative to its centre.");
  bind_state(
      chart_class, [](const StarChart& chart) { return nb::make_tuple(chart.mesh, chart.report); },
      [](const nb::object& state) {
        const auto [mesh, report] = nb::cast<std::pair<Mesh, StarReport>>(state);
        return StarChart{mesh, pair_edges(mesh), report};
      });
  chart_class.def_prop_ro("mesh", [](const StarChart& chart) { return chart.mesh; })
      .def_ro("report", &StarChart::report);
  m.def("make_star_chart", [](const Mesh& mesh, const ChartOptions& options, const Caller& caller) {
    return caller.run(
        [&](const Context& context) { return make_star_chart(mesh, options, context); });
  });
}

void bind_options(nb::module_& m) {
  Options<TransformOptions>(m, "TransformOptions",
                            "Options of the transform from a chart to coefficients.")
      .fields();
  Options<Tolerance>(m, "Tolerance", "Largest allowed error of a model.").fields();
  Options<CenterOptions>(m, "CenterOptions", "Options of the centre.").fields();
  m.def("parse_center", &parse_center);
  Options<ChartOptions>(m, "ChartOptions",
                        "Options of a chart: the centre, and surfaces that are not star-shaped.")
      .fields();
  Options<ExpandOptions>(m, "ExpandOptions", "Options of `expand`: degree, precision and errors.")
      .fields();
}

void bind_results(nb::module_& m) {
  Record<FastReport>(m, "FastReport", "Report of the fast engine.").fields();
  Record<Transform>(m, "Transform", "Report of a transform to coefficients.")
      .fields()
      .hidden("expansion", [](Transform& a) -> Expansion& { return a.expansion; })
      .type()
      .def_prop_ro("expansion", [](const Transform& a) { return a.expansion; });
  Record<ToleranceReport>(m, "ToleranceReport", "Report on a wanted tolerance.").fields();
  Record<Expanded>(m, "Expanded", "Report of `expand`.").fields();
}

void bind_expand(nb::module_& m) {
  m.def(
      "expand_mesh",
      [](const AnyVertices& vertices, const AnyTriangles& triangles, const ExpandOptions& options,
         const Caller& caller) {
        const MeshView view = view_of_arrays(vertices, triangles);
        return caller.run([&](const Context& context) { return expand(view, options, context); });
      },
      nb::arg().noconvert(), nb::arg().noconvert(), nb::arg(), nb::arg());
  m.def("expand_file",
        [](const std::string& path, const ExpandOptions& options, const Caller& caller) {
          std::vector<std::string> warnings;
          Expanded expanded = caller.run([&](const Context& context) {
            return expand_file(path, options, context, &warnings);
          });
          return nb::make_tuple(std::move(expanded), warnings);
        });
  m.def("expand_chart", [](const StarChart& chart, const TransformOptions& options,
                           const Caller& caller) {
    return caller.run([&](const Context& context) { return expand(chart, options, context); });
  });
  m.def("expand_chart_to_tolerance", [](const StarChart& chart, const Tolerance& tolerance,
                                        const TransformOptions& options, const Caller& caller) {
    ToleranceTransform found = caller.run(
        [&](const Context& context) { return expand(chart, tolerance, options, context); });
    return nb::make_tuple(
        std::move(found.transform),
        ToleranceReport{found.allowed, found.reached, found.met, std::move(found.degrees)});
  });
}

void bind_norms(nb::module_& m) {
  m.def("radius_norm_squared", [](const StarChart& chart) {
    return unlocked([&] { return radius_norm_squared(chart); });
  });
  m.def("gauge_norm_squared", unlocked_function(&gauge_norm_squared));
  m.def("tail_strength", [](const StarChart& chart, const std::string& function) {
    return unlocked([&] { return tail_strength(chart, parse_name<RadialFunction>(function)); });
  });
  m.def("vertex_error_strength", [](const StarChart& chart, const std::string& function) {
    return unlocked(
        [&] { return vertex_error_strength(chart, parse_name<RadialFunction>(function)); });
  });
  Record<ErrorStrengths>(m, "ErrorStrengths",
                         "Largest truncation errors at vertices, times 2 pi (L + 1).")
      .fields();
  m.def("vertex_error_strengths", [](const Mesh& mesh, const Vec3& center) {
    return unlocked([&] { return vertex_error_strengths(view_of(mesh), center); });
  });
  m.def("rms_beyond", [](const Expansion& expansion) {
    const RmsBeyond beyond = rms_beyond(expansion);
    std::vector<double> rms;
    rms.reserve(beyond.rms.size());
    for (const std::optional<double>& value : beyond.rms) {
      rms.push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    return array_of(std::move(rms));
  });
  m.def(
      "truncation_errors",
      [](const Mesh& mesh, const Expansion& expansion, std::optional<double> precision,
         bool predict, const Caller& caller) {
        return caller.run([&](const Context& context) {
          return truncation_errors(view_of(mesh), expansion, {precision, predict}, context);
        });
      },
      nb::arg(), nb::arg(), nb::arg().none(), nb::arg(), nb::arg());
}

void bind_monte_carlo(nb::module_& m) {
  Options<MonteCarloOptions>(m, "MonteCarloOptions", "Options of `monte_carlo`.").fields();
  Record<MonteCarlo>(m, "MonteCarlo", "Coefficients from random points, and their standard errors.")
      .fields()
      .hidden("expansion", [](MonteCarlo& found) -> Expansion& { return found.expansion; })
      .hidden("deviation", [](MonteCarlo& found) -> Coefficients& { return found.deviation; })
      .type()
      .def_prop_ro("expansion", [](const MonteCarlo& found) { return found.expansion; })
      .def_prop_ro("deviation", [](const MonteCarlo& found) { return found.deviation; });
  m.def("monte_carlo", [](const StarChart& chart, const MonteCarloOptions& options,
                          const Caller& caller) {
    return caller.run([&](const Context& context) { return monte_carlo(chart, options, context); });
  });
}

}  // namespace

void bind_transform(nb::module_& m) {
  bind_options(m);
  bind_star(m);
  bind_results(m);
  bind_expand(m);
  bind_norms(m);
  bind_monte_carlo(m);
}

}  // namespace rholm::python
