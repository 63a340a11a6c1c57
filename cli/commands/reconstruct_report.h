// What a reconstruction says of itself. Layer: cli.
#pragma once

#include <cstdint>
#include <string>

#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/reconstruct.h"

namespace rholm::cli {

// A surface that has been made, in one piece or in bricks.
struct Reconstructed {
  const ReconstructReport& report;
  std::uint64_t coefficients = 0;             // of all caps
  std::uint64_t vertices = 0, triangles = 0;  // of the surface
  double diagonal = 0;                        // of the points
  std::uint64_t bricks = 0;                   // 0: in one piece
  std::uint64_t stored = 0;                   // bytes, in bricks
};

Json json_of(const Reconstructed& made, bool confidence);
std::string report_text(const Reconstructed& made, const ReconstructOptions& options);

// Says what makes the surface doubtful; throws NotConverged where it should not be trusted. The
// output is written by then. `filled`: holes are.
void judge(const ReconstructReport& report, bool filled, Session& session);

}  // namespace rholm::cli
