// Surfaces from points.
#include "rholm/reconstruct.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <utility>

#include "bindings.h"
#include "caller.h"
#include "casters.h"
#include "record.h"

namespace rholm::python {

void bind_reconstruction(nb::module_& m) {
  Options<ReconstructOptions>(m, "ReconstructOptions", "What is wanted of the surface.")
      .field("step", &ReconstructOptions::step)
      .field("tolerance", &ReconstructOptions::tolerance)
      .field("noise", &ReconstructOptions::noise)
      .choice("holes", &ReconstructOptions::holes, parse_hole_policy, to_string)
      .choice("blend", &ReconstructOptions::blend, parse_cap_blend, to_string)
      .field("min_component", &ReconstructOptions::min_component)
      .field("remove_outliers", &ReconstructOptions::remove_outliers)
      .field("sensor", &ReconstructOptions::sensor)
      .field("align_scans", &ReconstructOptions::align_scans)
      .field("confidence", &ReconstructOptions::confidence)
      .field("simplify", &ReconstructOptions::simplify)
      .field("max_memory", &ReconstructOptions::max_memory);
  Record<ReconstructReport>(m, "ReconstructReport",
                            "What was found in the points, and what became of them; lengths are in "
                            "their unit.")
      .field("points", &ReconstructReport::points, "Number of points given.")
      .field("dropped_points", &ReconstructReport::dropped_points,
             "Not finite, at the place of another, without a normal.")
      .field("outliers", &ReconstructReport::outliers, "Points removed.")
      .field("computed_normals", &ReconstructReport::computed_normals,
             "Whether the points had none.")
      .field("scans", &ReconstructReport::scans, "What became of scans, if there are any.")
      .field("unsure", &ReconstructReport::unsure,
             "Share of the points the sign of whose computed normal is unsure.")
      .field("turned_normals", &ReconstructReport::turned_normals,
             "Whether all pointed into the solid, and were turned.")
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
  m.def("reconstruct",
        [](PointCloud cloud, const ReconstructOptions& options, const Caller& caller) {
          Reconstruction result = caller.run([&](const Context& context) {
            return reconstruct(std::move(cloud), options, context);
          });
          return nb::make_tuple(std::move(result.mesh), std::move(result.atlas),
                                std::move(result.report));
        });
}

}  // namespace rholm::python
