// Reconstruction of surfaces from points.
#include "rholm/reconstruct.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

#include <filesystem>
#include <utility>
#include <variant>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"

namespace rholm::python {
namespace {

using Points = std::variant<const PointCloud*, std::filesystem::path>;

// Reconstructs. `dropped` is the number of points that the reader of points in memory dropped.
nb::tuple reconstruct_any(const Points& points, std::size_t dropped, const std::string& columns,
                          ReconstructOptions options, const nb::object& foreseen,
                          const Caller& caller) {
  if (!foreseen.is_none()) {
    options.foreseen = [&foreseen](const TileForecast& forecast) {
      const nb::gil_scoped_acquire acquired;
      foreseen(forecast);
    };
  }
  Reconstruction made = caller.run([&](const Context& context) {
    if (const auto* path = std::get_if<std::filesystem::path>(&points)) {
      return reconstruct(*path, options, context, columns);
    }
    return reconstruct(*std::get<const PointCloud*>(points), options, context);
  });
  if (dropped > 0) {
    add_dropped(dropped, made.report);
    made.model.input_numbers = 3 * made.report.points;
  }
  if (!options.output.empty())
    return nb::make_tuple(nb::none(), nb::none(), std::move(made.report));
  return nb::make_tuple(std::move(made.mesh), std::move(made.model), std::move(made.report));
}

void bind_tiles(nb::module_& m) {
  Record<TileForecast>(m, "TileForecast", "What a reconstruction in tiles will take, about.")
      .fields();
  m.def("foresee_tiles", &foresee_tiles);
}

}  // namespace

void bind_reconstruction(nb::module_& m) {
  Options<ReconstructOptions>(m, "ReconstructOptions", "What is wanted of the surface.").fields();
  Record<ReconstructReport>(m, "ReconstructReport",
                            "What was found in the points, and what became of them; lengths are in "
                            "their unit.")
      .fields();
  m.def("reconstruct", &reconstruct_any, nb::arg("points"), nb::arg("dropped"), nb::arg("columns"),
        nb::arg("options"), nb::arg("foreseen").none(), nb::arg("caller"));
  bind_tiles(m);
}

}  // namespace rholm::python
