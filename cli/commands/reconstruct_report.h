// What a reconstruction says of itself. Layer: cli.
#pragma once

#include <string>

#include "cli/terminal/json_text.h"
#include "cli/terminal/session.h"
#include "rholm/reconstruct.h"

namespace rholm::cli {

Json json_of(const ReconstructReport& report, bool confidence);
std::string report_text(const ReconstructReport& report, const ReconstructOptions& options);

// Says what makes the surface doubtful; throws NotConverged where it should not be trusted. The
// output is written by then. `filled`: holes are.
void judge(const ReconstructReport& report, bool filled, Session& session);

}  // namespace rholm::cli
