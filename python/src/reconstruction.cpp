// Surfaces from points.
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

// `dropped` points were by the reader of points in memory.
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
      .field("points", &TileForecast::points, "That are finite, and no far strays.")
      .field("tiles", &TileForecast::tiles, "That space is cut into.")
      .field("memory", &TileForecast::memory, "Bytes, beside what is stored.")
      .field("stored", &TileForecast::stored,
             "Bytes between the steps, in a folder, or in memory if there is room for them.")
      .field("written", &TileForecast::written, "Bytes of the surface as a file.");
  m.def("foresee_tiles", &foresee_tiles);
}

}  // namespace

void bind_reconstruction(nb::module_& m) {
  Options<ReconstructOptions>(m, "ReconstructOptions", "What is wanted of the surface.").fields();
  Record<ReconstructReport>(m, "ReconstructReport",
                            "What was found in the points, and what became of them; lengths are in "
                            "their unit.")
      .field("points", &ReconstructReport::points, "Number of points given.")
      .field("dropped_points", &ReconstructReport::dropped_points,
             "Not finite, at the place of another, without a normal.")
      .field("outliers", &ReconstructReport::outliers, "Points removed.")
      .field("computed_normals", &ReconstructReport::computed_normals,
             "Whether the points had none, or given ones were replaced.")
      .field("scans", &ReconstructReport::scans, "What became of scans, if there are any.")
      .field("unsure", &ReconstructReport::unsure,
             "Share of the points the sign of whose computed normal is unsure.")
      .field("turned_normals", &ReconstructReport::turned_normals,
             "Whether all pointed into the solid, and were turned.")
      .field("mended_normals", &ReconstructReport::mended_normals,
             "Given normals that contradicted those around them, and were turned.")
      .field("crooked_normals", &ReconstructReport::crooked_normals,
             "Share of given normals more than 45 degrees off the surface; above 0.25 all are "
             "computed instead.")
      .field("contradicting_normals", &ReconstructReport::contradicting_normals,
             "Points whose normals contradict those around them, where turning does not help: "
             "above half the square root of the number of points the surface should not be "
             "trusted.")
      .field("contradictions", &ReconstructReport::contradictions,
             "The first three of these points, n x 3.")
      .field("crossing_length", &ReconstructReport::crossing_length,
             "Length of the lines along which sheets of the points cross, in diagonals of the "
             "points: above 0.12 the surface should not be trusted.")
      .field("crossings", &ReconstructReport::crossings,
             "The first three points near these lines, n x 3.")
      .field("points_off_surface", &ReconstructReport::points_off_surface,
             "Share of the points that fill what lies between the walls of the surface, or around "
             "it: above 0.5 the surface should not be trusted.")
      .field("places_off_surface", &ReconstructReport::places_off_surface,
             "Up to three of these points, n x 3.")
      .field("inward_normals", &ReconstructReport::inward_normals,
             "Share of the points at which the winding number contradicts the given normal: above "
             "0.1 the surface should not be trusted.")
      .field("spacing", &ReconstructReport::spacing,
             "Median distance between neighbours, as if on a square grid.")
      .field("noise", &ReconstructReport::noise, "Standard deviation along the normal.")
      .field("normal_noise_degrees", &ReconstructReport::normal_noise_degrees,
             "Of the normals against the surface.")
      .field("neighbours", &ReconstructReport::neighbours, "Points of a typical cap.")
      .field("caps", &ReconstructReport::caps, "Of the atlas.")
      .field("step", &ReconstructReport::step, "Edge of the grid's cubes.")
      .field("holes", &ReconstructReport::holes,
             "Places without points that were closed, or cut out.")
      .field("smooth_holes", &ReconstructReport::smooth_holes,
             "Of those closed, by a surface that continues the rim.")
      .field("cut_handles", &ReconstructReport::cut_handles,
             "Bridges and tunnels of the surface that were smaller than points can tell.")
      .field("dropped_components", &ReconstructReport::dropped_components,
             "Parts of the surface that were too small.")
      .field("faces", &ReconstructReport::faces, "Of the surface before it was simplified.")
      .field("simplify_error", &ReconstructReport::simplify_error, "By simplify().")
      .field("area", &ReconstructReport::area, "Of the surface.")
      .field("closed_area", &ReconstructReport::closed_area, "Of it, what closes holes.")
      .field("points_area", &ReconstructReport::points_area,
             "That the points stand for, by the circles of their neighbours.")
      .field("volume", &ReconstructReport::volume,
             "Signed, of the surface: negative if its normals point inwards.")
      .field("unseen_area", &ReconstructReport::unseen_area,
             "Of the surface, if confidence is asked for: share of the area without data nearer "
             "than three spacings.")
      .field("thin_area", &ReconstructReport::thin_area,
             "Of the surface, if confidence is asked for: share of the area thinner than one and a "
             "half spacings.")
      .field("unsure_area", &ReconstructReport::unsure_area,
             "Of the surface, if confidence is asked for: share of the area with a confidence "
             "below 1/2.")
      .field("memory", &ReconstructReport::memory, "Foreseen, bytes.")
      .field("times", &ReconstructReport::times, "Stages: (wall, cpu) in seconds.")
      .field("bounds", &ReconstructReport::bounds,
             "The box of the points that are finite; of several tiles without far strays.")
      .field("tiles", &ReconstructReport::tiles, "Number that space was cut into.")
      .field("stored", &ReconstructReport::stored,
             "Bytes between the steps of several tiles, at most at a time.")
      .field("vertices", &ReconstructReport::vertices, "Number of them, of the surface.")
      .field("triangles", &ReconstructReport::triangles, "Number of them, of the surface.")
      .field("coefficients", &ReconstructReport::coefficients, "Number of those of all caps.")
      .field("warnings", &ReconstructReport::warnings,
             "Of the file that the points were read from, list of str.");
  m.def("reconstruct", &reconstruct_any, nb::arg("points"), nb::arg("dropped"), nb::arg("columns"),
        nb::arg("options"), nb::arg("foreseen").none(), nb::arg("caller"));
  bind_tiles(m);
}

}  // namespace rholm::python
