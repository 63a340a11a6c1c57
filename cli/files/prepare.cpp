#include "cli/files/prepare.h"

#include <string_view>
#include <utility>

#include "cli/grammar/values.h"
#include "cli/options/field_options.h"
#include "rholm/coefficients_io.h"
#include "rholm/model.h"
#include "rholm/outward.h"
#include "rholm/topology.h"

namespace rholm::cli {

Option weld_option(double& tolerance) {
  Option option;
  for_each_field<ExpandOptions>([&](auto, const FieldInfo& info) {
    if (info.name == std::string_view("weld")) option = field_option(info, tolerance);
  });
  return option;
}

Option center_option(std::string& center) {
  Option option;
  for_each_field<CenterOptions>([&](auto, const FieldInfo& info) {
    if (info.name == std::string_view("center")) option = option_of(info, "");
  });
  option.value = "slope|kernel|cosine|none|centroid|volume|X,Y,Z";
  option.target = &center;
  option.check = [](const std::string&, const std::string& text) { parse_center_option(text); };
  return option;
}

Option length_unit_option(std::string& unit) {
  return {.name = "length-unit",
          .value = "NAME",
          .help = "name of the unit of length, for example km, which is stored in the file",
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

ChartOptions chart_options(ChartOptions options, const std::string& center) {
  const int rays = options.center.rays;
  options.center = parse_center_option(center);
  options.center.rays = rays;
  return options;
}

Prepared prepare(const Mesh& mesh, double weld_tolerance) {
  Outward shape = outward(mesh, weld_tolerance);
  Prepared result{.mesh = std::move(shape.welded.mesh), .flipped = shape.flipped};
  result.diagonal = bounds(result.mesh.vertices).diagonal();
  pair_edges(result.mesh);  // throws if the mesh is open or faces are inconsistent
  return result;
}

}  // namespace rholm::cli
