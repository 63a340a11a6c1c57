// Preparation of a mesh for a check of star-shapedness. Layer: cli.
#pragma once

#include "cli/grammar/command.h"
#include "cli/terminal/session.h"
#include "rholm/mesh.h"
#include "rholm/star.h"

namespace rholm::cli {

// Option "--weld T".
Option weld_option(double& tolerance);
// Option "--center KIND".
Option center_option(std::string& center);
CenterOptions parse_center_option(const std::string& text);  // throws UsageError
// Returns the options with that centre.
ChartOptions chart_options(ChartOptions options, const std::string& center);
// Option "--length-unit NAME".
Option length_unit_option(std::string& unit);

struct Prepared {
  Mesh mesh;  // welded, outward
  double diagonal = 0;
  bool flipped = false;
};

// Welds the mesh, turns it right side out, and checks that it is closed and oriented: the same
// first steps as expand(). Throws InvalidInput.
Prepared prepare(const Mesh& mesh, double weld_tolerance);

// Note on a mesh that was inside out.
inline constexpr const char* kFlipped = "the mesh was inside out, and its faces were reversed";
// Note on points whose normals all pointed inwards.
inline constexpr const char* kTurned = "all normals pointed inwards, and were reversed";

}  // namespace rholm::cli
