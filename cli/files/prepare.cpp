#include "cli/files/prepare.h"

#include <utility>

#include "cli/grammar/values.h"
#include "rholm/coefficients_io.h"
#include "rholm/outward.h"
#include "rholm/topology.h"

namespace rholm::cli {

Option weld_option(double& tolerance) {
  return {.name = "weld",
          .value = "T",
          .help =
              "make vertices one whose distance is at most T, in the shape's unit; 0 (the "
              "default) joins identical ones",
          .target = &tolerance,
          .min = 0};
}

Option center_option(std::string& center) {
  return {
      .name = "center",
      .value = "slope|kernel|cosine|none|centroid|volume|X,Y,Z",
      .help =
          "slope, or auto (the default): where the radius has the least slope, on the line through "
          "kernel and the centroid of the solid, well within the points that see the whole "
          "surface; "
          "kernel: in the middle of these points; cosine: where the surface is seen least aslant; "
          "none: the file's origin; "
          "centroid: of the surface; volume: of the solid, or as slope where not all is seen "
          "from there",
      .target = &center,
      .check = [](const std::string&, const std::string& text) { parse_center_option(text); }};
}

Option length_unit_option(std::string& unit) {
  return {.name = "length-unit",
          .value = "NAME",
          .help = "unit of the mesh's lengths, as in km, to be written into the file",
          .target = &unit,
          .check = [](const std::string& option, const std::string& text) {
            check_by(option, text, [&] { check_unit(text); });
          }};
}

CenterOptions parse_center_option(const std::string& text) {
  CenterOptions options;
  check_by("--center", text, [&] { options = parse_center(text); });
  return options;
}

Option rays_option(int& rays) {
  return {.name = "rays",
          .value = "N",
          .help =
              "directions that are tried to see how often they meet the surface; 100000 by "
              "default, 0 tries none",
          .target = &rays,
          .min = 0,
          .max = 100'000'000};
}

Prepared prepare(const Mesh& mesh, double weld_tolerance) {
  Outward shape = outward(mesh, weld_tolerance);
  Prepared result{.mesh = std::move(shape.welded.mesh), .flipped = shape.flipped};
  result.diagonal = bounds(result.mesh.vertices).diagonal();
  pair_edges(result.mesh);  // throws if the mesh is open or its faces disagree
  return result;
}

}  // namespace rholm::cli
