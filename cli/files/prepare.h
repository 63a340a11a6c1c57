// What has to be done to a mesh before questions about stars make sense. Layer: cli.
#pragma once

#include "cli/grammar/command.h"
#include "cli/terminal/session.h"
#include "rholm/mesh.h"
#include "rholm/star.h"

namespace rholm::cli {

// "--weld T".
Option weld_option(double& tolerance);
// "--center KIND".
Option center_option(std::string& center);
CenterOptions parse_center_option(const std::string& text);  // throws UsageError
// With that centre.
ChartOptions chart_options(ChartOptions options, const std::string& center);
// "--length-unit NAME".
Option length_unit_option(std::string& unit);

struct Prepared {
  Mesh mesh;  // welded, outward
  double diagonal = 0;
  bool flipped = false;
};

// Welds, turns right side out, checks that the mesh is closed and oriented: the same first steps
// as encode(). Throws InvalidInput.
Prepared prepare(const Mesh& mesh, double weld_tolerance);

// What to say of a mesh that was inside out.
inline constexpr const char* kFlipped =
    "the mesh was inside out, it has been turned right side out";
// The same of points.
inline constexpr const char* kTurned =
    "all normals pointed inwards, they have been turned outwards";

}  // namespace rholm::cli
