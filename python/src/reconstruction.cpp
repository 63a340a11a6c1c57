// Surfaces from points.
#include "rholm/reconstruct.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

#include <filesystem>
#include <system_error>
#include <utility>
#include <variant>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"
#include "rholm/error.h"
#include "rholm/point_stream.h"
#include "rholm/reconstruct_bricks.h"

namespace rholm::python {
namespace {

using Points = std::variant<const PointCloud*, std::filesystem::path>;

// Whether the points of a file are read a piece at a time: not where faces have to be asked for
// normals. Pipes are not opened to find out, as they are read once.
bool is_streamed(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error)) {
    return true;
  }
  try {
    return !PointStream(path).has_faces();
  } catch (const Error& refused) {
    if (refused.code() == ErrorCode::kUnsupported) return false;
    throw;
  }
}

// `dropped` points were by the reader of points in memory.
BrickReconstruction reconstruct_in_bricks(const Points& points, std::size_t dropped,
                                          const std::filesystem::path& mesh,
                                          const ReconstructOptions& options, BrickOptions bricks,
                                          const nb::object& foreseen, const Caller& caller) {
  if (!foreseen.is_none()) {
    bricks.foreseen = [&foreseen](const BrickForecast& forecast) {
      const nb::gil_scoped_acquire acquired;
      foreseen(forecast);
    };
  }
  return caller.run([&](const Context& context) {
    if (const auto* path = std::get_if<std::filesystem::path>(&points)) {
      return reconstruct_bricks(*path, mesh, options, bricks, context);
    }
    BrickReconstruction made =
        reconstruct_bricks(*std::get<const PointCloud*>(points), mesh, options, bricks, context);
    add_dropped(dropped, made.report);
    return made;
  });
}

void bind_bricks(nb::module_& m) {
  m.attr("BRICK_POINTS") = kBrickPoints;
  Options<BrickOptions>(m, "BrickOptions", "How points are cut into bricks, and what is kept.")
      .fields();
  Record<BrickForecast>(m, "BrickForecast", "What a reconstruction in bricks will take, about.")
      .field("points", &BrickForecast::points, "That are finite, and no far strays.")
      .field("bricks", &BrickForecast::bricks, "That space is cut into.")
      .field("memory", &BrickForecast::memory, "Bytes, beside what is stored.")
      .field("stored", &BrickForecast::stored,
             "Bytes in the folder, or in memory if there is none.")
      .field("written", &BrickForecast::written, "Bytes of the surface's file.");
  Record<BrickReconstruction>(m, "BrickReconstruction",
                              "What was found in points that were worked on in bricks, and how "
                              "much was made of them; lengths are in their unit.")
      .field("report", &BrickReconstruction::report,
             "What was found in the points, and what became of them, with the times of the stages "
             "in bricks.")
      .field("bounds", &BrickReconstruction::bounds, "The box of the points, without far strays.")
      .field("bricks", &BrickReconstruction::bricks, "Number that space was cut into.")
      .field("vertices", &BrickReconstruction::vertices, "Number of them, of the surface.")
      .field("triangles", &BrickReconstruction::triangles, "Number of them, of the surface.")
      .field("coefficients", &BrickReconstruction::coefficients, "Number of those of all caps.")
      .field("stored", &BrickReconstruction::stored,
             "Bytes between the steps, at most at a time, in the folder or in memory.")
      .field("warnings", &BrickReconstruction::warnings, "Of the file of points, list of str.");
  m.def("is_streamed", [](const std::filesystem::path& path) {
    return unlocked([&] { return is_streamed(path); });
  });
  m.def("foresee_bricks", &foresee_bricks);
  m.def("reconstruct_bricks", &reconstruct_in_bricks, nb::arg("points"), nb::arg("dropped"),
        nb::arg("mesh"), nb::arg("options"), nb::arg("bricks"), nb::arg("foreseen").none(),
        nb::arg("caller"));
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
      .field("times", &ReconstructReport::times, "Stages: (wall, cpu) in seconds.");
  m.def("reconstruct", [](PointCloud cloud, std::size_t dropped, const ReconstructOptions& options,
                          const Caller& caller) {
    Reconstruction result = caller.run(
        [&](const Context& context) { return reconstruct(std::move(cloud), options, context); });
    add_dropped(dropped, result.report);
    result.model.input_numbers = 3 * result.report.points;  // with those that the reader dropped
    return nb::make_tuple(std::move(result.mesh), std::move(result.model),
                          std::move(result.report));
  });
  bind_bricks(m);
}

}  // namespace rholm::python
